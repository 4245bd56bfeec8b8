// SPDX-License-Identifier: MIT
#include "read_scene.hpp"

#include <cstdio>
#include <string>

#include <glint/io/scene_json.hpp>

glint::SceneFile read_scene(const SceneArguments& arguments) {
  glint::SceneFile scene = glint::read_scene(
      arguments.path,
      {.overrides = arguments.overrides, .integrator = arguments.integrator, .strict = arguments.strict});
  for (const std::string& warning : scene.warnings) std::fprintf(stderr, "glint: warning: %s\n", warning.c_str());
  return scene;
}
