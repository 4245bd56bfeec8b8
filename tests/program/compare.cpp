// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include <glint/io/image.hpp>

#include <support/catch.hpp>

#include "program.hpp"

namespace {

using glint::Image;
using glint::testing::content_of;
using glint::testing::entries_below;
using glint::testing::glint_program;
using glint::testing::is_one_sentence;
using glint::testing::Outcome;
using glint::testing::TemporaryDirectory;

/// b.exr is 0.5 everywhere; a.exr the same but for one of eight pixels, which is 1.
struct Pair {
  TemporaryDirectory directory;

  Pair() {
    Image image({4, 2}, 0.5F);
    write_exr(image, directory / "b.exr");
    image(3, 1) = 1;
    write_exr(image, directory / "a.exr");
  }

  [[nodiscard]] Outcome compare(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "compare");
    return glint_program(directory.path(), arguments);
  }
};

}  // namespace

TEST_CASE("program: compare tells all figures", "[program]") {
  const Pair pair;
  const Outcome outcome = pair.compare({"a.exr", "b.exr"});
  CHECK(outcome.status == 0);
  CHECK(outcome.err.empty());
  // One of eight pixels off by 0.5: MSE 1/8 · 1/4, relMSE that over 0.26, mean 4.5 / 4.
  CHECK(outcome.out ==
        "mean ratio   1.125\nMSE          0.03125\nRMSE         0.176777\nrelMSE       0.120192\n"
        "off > 0.01   0.125\nlargest      0.5\n");
}

TEST_CASE("program: compare of an image with itself finds nothing", "[program]") {
  const Pair pair;
  const Outcome outcome = pair.compare(
      {"a.exr", "a.exr", "--max-rmse", "0", "--max-relmse", "0", "--max-share", "0", "--max-mean-error", "0"});
  CHECK(outcome.status == 0);
  CHECK(outcome.out.find("OVER") == std::string::npos);
}

TEST_CASE("program: compare fails over any limit", "[program]") {
  const Pair pair;
  const std::vector<std::pair<std::string, std::pair<std::string, std::string>>> limits{
      {"--max-rmse", {"0.17", "0.18"}},
      {"--max-relmse", {"0.12", "0.13"}},
      {"--max-mean-error", {"0.12", "0.13"}},
      {"--max-share", {"0.12", "0.13"}}};
  for (const auto& [option, values] : limits) {
    CAPTURE(option);
    const Outcome over = pair.compare({"a.exr", "b.exr", option, values.first});
    CHECK(over.status == 1);
    CHECK(over.out.find("OVER the limit of " + values.first) != std::string::npos);
    const Outcome within = pair.compare({"a.exr", "b.exr", option, values.second});
    CHECK(within.status == 0);
    CHECK(within.out.find("within the limit of " + values.second) != std::string::npos);
  }
}

TEST_CASE("program: compare lets no broken image pass", "[program]") {
  const Pair pair;
  Image image({4, 2}, 0.5F);
  image(0, 0).g = std::numeric_limits<float>::quiet_NaN();
  write_exr(image, pair.directory / "nan.exr");
  CHECK(pair.compare({"nan.exr", "b.exr", "--max-rmse", "1000"}).status == 1);
  CHECK(pair.compare({"nan.exr", "b.exr", "--max-mean-error", "1000"}).status == 1);
  CHECK(pair.compare({"a.exr", "b.exr", "--max-rmse", "nan"}).status == 1);
}

TEST_CASE("program: compare writes the difference as an image", "[program]") {
  const Pair pair;
  CHECK(pair.compare({"a.exr", "b.exr", "--difference", "d.exr"}).status == 0);
  const Image difference = glint::read_exr(pair.directory / "d.exr");
  CHECK(difference(3, 1) == glint::Rgb{0.5F});
  CHECK(difference(0, 0) == glint::Rgb{0});
}

TEST_CASE("program: compare overwrites none of its images", "[program]") {
  const Pair pair;
  const std::string before = content_of(pair.directory / "a.exr");
  std::filesystem::create_hard_link(pair.directory / "a.exr", pair.directory / "link.exr");
  for (const char* const name : {"a.exr", "./b.exr", "link.exr"}) {
    const Outcome outcome = pair.compare({"a.exr", "b.exr", "--difference", name});
    CHECK(outcome.status == 1);
    CHECK(outcome.err == std::string("glint: ") + name + ": is an input: name another output\n");
  }
  CHECK(content_of(pair.directory / "a.exr") == before);
}

TEST_CASE("program: compare refuses images of different sizes, and what is no image", "[program]") {
  const Pair pair;
  write_exr(Image({3, 2}), pair.directory / "c.exr");
  pair.directory.write("cut.exr", content_of(pair.directory / "a.exr").substr(0, 200));
  const auto before = entries_below(pair.directory.path());
  const Outcome sizes = pair.compare({"a.exr", "c.exr"});
  CHECK(sizes.status == 1);
  CHECK(sizes.err == "glint: a.exr: has 4x2 pixels, but c.exr has 3x2\n");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"a.exr", "no.exr"},
                                                    {"no.exr", "a.exr"},
                                                    {"cut.exr", "a.exr"},
                                                    {"a.exr"},
                                                    {"a.exr", "b.exr", "--difference", "no/d.exr"},
                                                    {"a.exr", "b.exr", "--difference", "d.jpg"},
                                                    {"a.exr", "b.exr", "--max-rmse", "much"},
                                                    {"a.exr", "b.exr", "c.exr"}}) {
    const Outcome outcome = pair.compare(arguments);
    CAPTURE(arguments, outcome.err);
    CHECK((outcome.status == 1 || outcome.status == 2));
    CHECK(is_one_sentence(outcome.err));
    CHECK(outcome.out.empty());
  }
  CHECK(entries_below(pair.directory.path()) == before);
}
