// SPDX-License-Identifier: MIT
#include <glint/scene/at_time.hpp>  // first, so the header proves it stands alone

#include <glint/bvh/bvh.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/camera/shutter.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/set/moving.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/integrator/path.hpp>
#include <glint/light/environment.hpp>
#include <glint/render/render.hpp>
#include <glint/scene/scene.hpp>

#include <support/catch.hpp>

namespace test_scene_at_time {

namespace {

/// A square, two wide, whose left edge is here.
glint::MeshBuffers<float> square_from(float x) {
  return {.positions = {{x, -1, 0}, {x + 2, -1, 0}, {x + 2, 1, 0}, {x, 1, 0}},
          .normals = {},
          .uvs = {},
          .indices = {0, 1, 2, 0, 2, 3}};
}

const auto early = square_from(0);
const auto late = square_from(4);
const glint::Scene scene{glint::Bvh{glint::Moving{view(early), view(late)}}, glint::Lambertian{glint::Rgb{0}},
                         glint::ConstantEnvironment{glint::Rgb{1}}};

}  // namespace

TEST_CASE("scene at a time: every ray has that time", "[scene]") {
  const glint::Ray<float> ray{.origin = {5, 0, 3}};
  const glint::AtTime begin{scene, 0.0F};
  const glint::AtTime end{scene, 1.0F};
  static_assert(glint::SceneLike<decltype(begin)>);
  CHECK_FALSE(begin.interact(ray));
  CHECK_FALSE(begin.occluded(ray));
  CHECK(end.interact(ray));
  CHECK(end.occluded(ray));
  CHECK(end.background({0, 0, 1}) == glint::Rgb{1});
  CHECK(end.light_count() == 1);
  CHECK(&end.light(0) == &scene.light(0));
  CHECK(&end.light_sampler() == &scene.light_sampler());
  CHECK(end.infinite_lights().size() == 1);
}

TEST_CASE("scene at a time: what a pixel sees is dark for as long as the square passes", "[scene]") {
  // The point x = 3 is covered from when the right edge, 2 + 4 · time, gets there until the left one, 4 · time, does:
  // for half of the time. The square is black and the sky white.
  const glint::Perspective camera{.eye = {3, 0, 1000}, .target = {3, 0, 0}, .fov_y_radians = 1e-6F};
  glint::Film film{{1, 1}};
  const int samples = 4096;
  render(scene, glint::Shutter{camera}, glint::Path{.max_depth = 2}, film, {.samples = samples});
  // Each sample is 0 or 1, so the mean has a standard deviation of ½ / √4096 = 0.0078: five of them.
  CHECK(film.develop()(0, 0).g == Approx(0.5F).margin(0.04));
  // A shutter that is open while the point is free sees the sky alone; one that closes at once sees one moment.
  for (const float time : {0.1F, 0.4F}) {
    glint::Film still{{1, 1}};
    render(scene, glint::Shutter{camera, time, time}, glint::Path{.max_depth = 2}, still, {.samples = 16});
    CHECK(still.develop()(0, 0).g == (time < 0.25F ? 1.0F : 0.0F));
  }
}

}  // namespace test_scene_at_time
