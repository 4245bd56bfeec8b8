// SPDX-License-Identifier: MIT
// The Cornell box, composed from headers: writes cornell_box.exr and cornell_box.png. Its argument is the number of
// samples a pixel. Geometry: Cornell University Program of Computer Graphics, "Cornell Box Data", 1998; the lamp hangs
// a tenth of a millimeter lower, to be off the ceiling. Colors: RGB in place of the measured spectra.
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <glm/vec3.hpp>

#include <glint/glint.hpp>

namespace {

enum Material : std::uint32_t { White, Red, Green, Black };

struct Face {
  Material material;
  std::array<glm::vec3, 4> corners;  // millimeters, counterclockwise from where it is seen
};

const std::array faces{
    Face{White, {{{552.8F, 0, 0}, {0, 0, 0}, {0, 0, 559.2F}, {549.6F, 0, 559.2F}}}},                   // floor
    Face{White, {{{556, 548.8F, 0}, {556, 548.8F, 559.2F}, {0, 548.8F, 559.2F}, {0, 548.8F, 0}}}},     // ceiling
    Face{White, {{{549.6F, 0, 559.2F}, {0, 0, 559.2F}, {0, 548.8F, 559.2F}, {556, 548.8F, 559.2F}}}},  // back wall
    Face{Green, {{{0, 0, 559.2F}, {0, 0, 0}, {0, 548.8F, 0}, {0, 548.8F, 559.2F}}}},                   // right wall
    Face{Red, {{{552.8F, 0, 0}, {549.6F, 0, 559.2F}, {556, 548.8F, 559.2F}, {556, 548.8F, 0}}}},       // left wall
    Face{White, {{{130, 165, 65}, {82, 165, 225}, {240, 165, 272}, {290, 165, 114}}}},                 // short block
    Face{White, {{{290, 0, 114}, {290, 165, 114}, {240, 165, 272}, {240, 0, 272}}}},
    Face{White, {{{130, 0, 65}, {130, 165, 65}, {290, 165, 114}, {290, 0, 114}}}},
    Face{White, {{{82, 0, 225}, {82, 165, 225}, {130, 165, 65}, {130, 0, 65}}}},
    Face{White, {{{240, 0, 272}, {240, 165, 272}, {82, 165, 225}, {82, 0, 225}}}},
    Face{White, {{{423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}}}},  // tall block
    Face{White, {{{423, 0, 247}, {423, 330, 247}, {472, 330, 406}, {472, 0, 406}}}},
    Face{White, {{{472, 0, 406}, {472, 330, 406}, {314, 330, 456}, {314, 0, 456}}}},
    Face{White, {{{314, 0, 456}, {314, 330, 456}, {265, 330, 296}, {265, 0, 296}}}},
    Face{White, {{{265, 0, 296}, {265, 330, 296}, {423, 330, 247}, {423, 0, 247}}}},
};

}  // namespace

int main(int argc, char** argv) {
  const int samples = argc > 1 ? std::atoi(argv[1]) : 16;

  glint::MeshBuffers<float> walls;
  glint::MaterialTable<glint::Lambertian> materials{
      .materials = {{{0.73F, 0.73F, 0.73F}}, {{0.63F, 0.065F, 0.05F}}, {{0.14F, 0.45F, 0.091F}}, {0}}};
  for (const Face& face : faces) {
    const auto first = static_cast<std::uint32_t>(walls.positions.size());
    for (const glm::vec3& corner : face.corners) walls.positions.push_back(corner * 0.001F);
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) walls.indices.push_back(first + corner);
    materials.of_primitive.insert(materials.of_primitive.end(), 2, face.material);
  }

  const std::vector<glint::Quad<float>> lamp{{{0.213F, 0.5487F, 0.227F}, {0.13F, 0, 0}, {0, 0, 0.105F}}};
  materials.of_primitive.push_back(Black);
  glint::Lights<glint::AreaLight<glint::Quad<float>>> lights{{{lamp[0], {17, 12, 4}}}};
  lights.of_primitive.resize(2 * faces.size(), glint::none<std::uint32_t>);
  lights.of_primitive.push_back(0);

  const glint::TbbExecutor executor;
  const glint::Scene scene{glint::Bvh{glint::Joined{glint::view(walls), glint::Elements{lamp}}}, materials, lights};
  const glint::Perspective camera{
      .eye = {0.278F, 0.273F, -0.8F}, .target = {0.278F, 0.273F, 0}, .fov_y_radians = glint::radians(39.3077F)};
  glint::Film film{{256, 256}};
  const auto report = glint::render(scene, camera, glint::Path{}, film, {.samples = samples}, executor,
                                    glint::Stratified{.samples_per_pixel = samples});
  glint::write_exr(film.develop(), "cornell_box.exr");
  glint::write_png(film.develop(), "cornell_box.png");
  std::printf("%.1f million rays in %.1f s\n", static_cast<double>(report.rays) * 1e-6, report.seconds);
}
