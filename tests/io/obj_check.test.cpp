// SPDX-License-Identifier: MIT
#include <glint/io/obj_check.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <support/catch.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_obj_check {

namespace {

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";  // three lines

std::vector<std::uint32_t> counts(std::string_view text) {
  return glint::detail::ObjCheck("m.obj").corner_counts(text);
}

std::string mistake(const std::string& text) {
  return glint::testing::message_of<glint::IoError>([&] { (void)counts(text); }, "m.obj");
}

}  // namespace

TEST_CASE("obj check: the corners of each face are counted", "[io][obj]") {
  CHECK(counts(triangle + "f 1 2 3\nv 1 1 0\nf 1 2 4 3\n") == std::vector<std::uint32_t>{3, 4});
}

TEST_CASE("obj check: every way to name a corner is understood", "[io][obj]") {
  CHECK(counts(triangle + "vt 0 0\nvt 0.5\nvn 0 0 1\nf 1 2 3\nf 1/1 2/2 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/2/1 3/1/-1\n"
                          "f -3 -2 -1\n")
            .size() == 5);
}

TEST_CASE("obj check: comments, other keywords, blank lines and every line end pass", "[io][obj]") {
  CHECK(
      counts("# 1\r\n\r\n\to cube # 2\r\n  v\t0 0 0 1 # w\r\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nusemtl f\nf 1 2 3").size() ==
      1);
  CHECK(counts("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r").size() == 1);
}

TEST_CASE("obj check: numbers may be written in every usual way", "[io][obj]") {
  CHECK_NOTHROW(counts("v +1 -.5 5.\nv 1e3 1E-3 +2.5e+2\nv 1e-60 -1e-400 0\nf 1 2 3\n"));
}

TEST_CASE("obj check: a face may refer to vertices that come later", "[io][obj]") {
  CHECK_NOTHROW(counts("f 1 2 3\n" + triangle));
}

TEST_CASE("obj check: indices of what is not there are refused with their line", "[io][obj]") {
  CHECK(mistake(triangle + "f 1 2 99\n") == ":4: face refers to vertex 99, but the file has 3 vertices");
  CHECK(mistake("v 0 0 0\n\n# more\nf 1 1 2\nf 7 7 7") == ":4: face refers to vertex 2, but the file has 1 vertex");
  CHECK(mistake(triangle + "vt 0 0\nf 1/1 2/2 3/1\n") ==
        ":5: face refers to texture coordinate 2, but the file has 1 texture coordinate");
  CHECK(mistake(triangle + "f 1//1 2//1 3//1\n") == ":4: face refers to normal 1, but the file has 0 normals");
  CHECK(mistake(triangle + "f 0 1 2\n") ==
        ":4: face refers to vertex 0, but counting begins at 1, or at -1 from the end");
  CHECK(mistake(triangle + "f -1 -2 -4\nv 1 1 1\n") ==
        ":4: face refers to 4 vertices back, but the file has 3 vertices before this line");
}

TEST_CASE("obj check: faces need three corners of a known form", "[io][obj]") {
  CHECK(mistake(triangle + "f 1 2\n") == ":4: face has 2 corners, expected at least 3");
  CHECK(mistake(triangle + "f\n") == ":4: face has 0 corners, expected at least 3");
  const std::string corner = GENERATE("x", "1/", "1//", "1/1/", "1.5", "1/1/1/1", "99999999999", "1,", "\\");
  CAPTURE(corner);
  CHECK(mistake(triangle + "vt 0 0\nvn 0 0 1\nf 1 2 " + corner + "\n") ==
        ":6: face corner \"" + corner + "\" is not of the form v, v/vt, v//vn or v/vt/vn");
}

TEST_CASE("obj check: numbers must be numbers, and finite ones", "[io][obj]") {
  const std::string word = GENERATE("x", "1,5", "1.5.2", "0x10", "--1", "+-1", "+", "-", "1e", "1.#QNAN");
  CAPTURE(word);
  CHECK(mistake("v 0 0 0\nv 1 " + word + " 0\n") == ":2: vertex has \"" + word + "\", expected a number");
  CHECK(mistake("vn 1 " + word + " 0\n") == ":1: normal has \"" + word + "\", expected a number");
  CHECK(mistake("vt 1 " + word + "\n") == ":1: texture coordinate has \"" + word + "\", expected a number");
  const std::string infinite = GENERATE("nan", "inf", "-INF", "1e39", "-1e999");
  CAPTURE(infinite);
  CHECK(mistake("v 0 0 0\nv 1 " + infinite + " 0\n") == ":2: vertex has " + infinite + ", expected a finite number");
}

TEST_CASE("obj check: vertices, normals and texture coordinates have enough numbers", "[io][obj]") {
  CHECK(mistake("v 0 1\n") == ":1: vertex has 2 numbers, expected 3");
  CHECK(mistake("vn 1\n") == ":1: normal has 1 number, expected 3");
  CHECK(mistake("vt\n") == ":1: texture coordinate has 0 numbers, expected 1");
}

TEST_CASE("obj check: a file without faces is no mesh", "[io][obj]") {
  CHECK(mistake(triangle) == ": has no faces, expected a mesh");
  CHECK(mistake("") == ": has no faces, expected a mesh");
}

}  // namespace test_io_obj_check
