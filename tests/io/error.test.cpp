// SPDX-License-Identifier: MIT
#include <glint/io/error.hpp>  // first, so the header proves it stands alone

#include <string>

#include <support/catch.hpp>

namespace test_io_error {

TEST_CASE("io error: the message is file, line and problem, as compilers print them", "[io][error]") {
  const glint::IoError error("meshes/cornell.obj", 12, "face refers to vertex 99, but the file has 8 vertices");
  CHECK(std::string(error.what()) == "meshes/cornell.obj:12: face refers to vertex 99, but the file has 8 vertices");
  CHECK(error.path() == "meshes/cornell.obj");
  CHECK(error.place() == "12");
}

TEST_CASE("io error: a place may be a JSON pointer", "[io][error]") {
  const glint::IoError error("room.json", "/materials/glass", "unknown type");
  CHECK(std::string(error.what()) == "room.json:/materials/glass: unknown type");
  CHECK(error.place() == "/materials/glass");
}

TEST_CASE("io error: a problem with the file as a whole has no place", "[io][error]") {
  const glint::IoError error("room.json", "is empty");
  CHECK(std::string(error.what()) == "room.json: is empty");
  CHECK(error.place().empty());
}

}  // namespace test_io_error
