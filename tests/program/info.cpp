// SPDX-License-Identifier: MIT
#include <string>

#include <glint/io/image.hpp>

#include <support/catch.hpp>

#include "program.hpp"

namespace {

using glint::testing::glint_program;
using glint::testing::is_one_sentence;
using glint::testing::Outcome;
using glint::testing::TemporaryDirectory;
using glint::testing::write_scene;

bool says(const Outcome& outcome, const std::string& line) {
  return outcome.out.find(line + "\n") != std::string::npos;
}

}  // namespace

TEST_CASE("program: info of a scene", "[program]") {
  const TemporaryDirectory directory;
  write_scene(directory);
  const Outcome outcome = glint_program(directory.path(), {"info", "scene.json"});
  CHECK(outcome.status == 0);
  CHECK(outcome.err.empty());
  CHECK(says(outcome, "scene          2 triangles, 1 spheres, 0 disks, 0 rectangles"));
  CHECK(says(outcome, "film           24x16, 4 samples a pixel"));
  CHECK(says(outcome, "bounds         (-3, 0, -3) to (3, 2, 3)"));
  CHECK(says(outcome, "reads          floor.obj"));
}

TEST_CASE("program: info of a mesh", "[program]") {
  const TemporaryDirectory directory;
  write_scene(directory);
  const Outcome outcome = glint_program(directory.path(), {"info", "floor.obj"});
  CHECK(outcome.status == 0);
  CHECK(says(outcome, "mesh           2 triangles, 4 vertices, 0 materials"));
  CHECK(says(outcome, "bounds         (-3, 0, -3) to (3, 0, 3)"));
}

TEST_CASE("program: info of an image", "[program]") {
  const TemporaryDirectory directory;
  glint::Image image({2, 1}, {1, 2, 3});
  image(1, 0) = {0, 0, -1};
  write_exr(image, directory / "image.exr");
  const Outcome outcome = glint_program(directory.path(), {"info", "image.exr"});
  CHECK(outcome.status == 0);
  CHECK(says(outcome, "image          2x1 pixels"));
  CHECK(says(outcome, "mean           0.5 1 1"));
  CHECK(says(outcome, "lowest         0 0 -1"));
  CHECK(says(outcome, "highest        1 2 3"));
}

TEST_CASE("program: info of anything else is an error", "[program]") {
  const TemporaryDirectory directory;
  for (const char* const name : {"no.json", "no.obj", "no.exr", "no.txt", "no"}) {
    const Outcome outcome = glint_program(directory.path(), {"info", name});
    CAPTURE(outcome.err);
    CHECK(outcome.status == 1);
    CHECK(is_one_sentence(outcome.err));
    CHECK(outcome.err.find(name) != std::string::npos);
  }
}

TEST_CASE("program: help and version go to the standard output, with status 0", "[program]") {
  const TemporaryDirectory directory;
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"render", "--help"},
                                                    {"compare", "-h"},
                                                    {"info", "--help"},
                                                    {"--version"}}) {
    const Outcome outcome = glint_program(directory.path(), arguments);
    CHECK(outcome.status == 0);
    CHECK_FALSE(outcome.out.empty());
    CHECK(outcome.err.empty());
  }
}
