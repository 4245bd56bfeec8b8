// SPDX-License-Identifier: MIT
// Renders a scene file from C++: the file that the argument names, or a small one that it writes itself.
#include <cstdio>
#include <fstream>
#include <string>

#include <glint/core/tbb_executor.hpp>
#include <glint/film/film.hpp>
#include <glint/io/image.hpp>
#include <glint/io/scene_json.hpp>
#include <glint/render/render.hpp>

namespace {

void write_small_scene(const std::string& path) {
  std::ofstream(path) << R"({
  "integrator": { "type": "path", "spp": 16 },
  "film": { "resolution": [160, 120] },
  "camera": { "position": [0, 1.5, 5], "look_at": [0, 0.7, 0] },
  "textures": { "tiles": { "type": "checkerboard", "tex_coordinate_generator": { "scale": [10, 10] } } },
  "materials": { "tiles": { "texture_name": "tiles" }, "glass": { "type": "glass" } },
  "objects": [
    { "type": "rectangle", "edge_u": [0, 0, 10], "edge_v": [10, 0, 0], "material_name": "tiles" },
    { "type": "sphere", "center": [0, 1, 0], "material_name": "glass" },
    { "type": "disk", "center": [0, 6, 0], "normal": [0, -1, 0], "light": { "radiance": [25, 25, 22] } }
  ]
})";
}

}  // namespace

int main(int argc, char** argv) {
  const std::string path = argc > 1 ? argv[1] : "small.json";
  if (argc <= 1) write_small_scene(path);

  // <region: render>
  const glint::TbbExecutor executor;
  const glint::SceneFile file = glint::read_scene(path);
  for (const std::string& warning : file.warnings) std::puts(warning.c_str());

  const auto any_scene = glint::any_scene_of(file, executor);
  glint::Film film{file.film.resolution, file.film.filter};
  const auto render_by = [&](const auto& scene, const auto& integrator) {
    glint::render(scene, file.camera, integrator, film, glint::options_of(file), executor,
                  glint::sequence_of(file.sampler, file.integrator.samples));
  };
  any_scene.visit([&](const auto& scene) {
    file.integrator.integrator.visit([&](const auto& integrator) { render_by(scene, integrator); });
  });
  glint::write_image(film.develop(executor), "scene.exr");
  // </region: render>
  glint::write_png(film.develop(executor), "scene.png");
}
