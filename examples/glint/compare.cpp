// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

#include <glint/color/compare.hpp>
#include <glint/io/image.hpp>

#include "commands.hpp"
#include "output.hpp"

namespace {

/// |a − b|, channel by channel.
glint::Image absolute_difference(const glint::Image& a, const glint::Image& b) {
  glint::Image result(a.size());
  for (std::size_t i = 0; i < result.pixels().size(); ++i) {
    const glint::Rgb gap = a.pixels()[i] - b.pixels()[i];
    result.pixels()[i] = {std::abs(gap.r), std::abs(gap.g), std::abs(gap.b)};
  }
  return result;
}

/// Prints one figure and, where there is a limit, whether it holds. NaN holds no limit.
bool report(const char* name, double value, double tested, double limit) {
  const bool holds = tested <= limit || std::isinf(limit);
  std::printf("%-12s %.6g", name, value);
  if (!std::isinf(limit)) std::printf("  %s the limit of %g", holds ? "within" : "OVER", limit);
  std::printf("\n");
  return holds;
}

/// Finds out before the work whether its result can be written, and would overwrite nothing that is read.
void require_writable(const CompareArguments& arguments) {
  const std::filesystem::path& output = arguments.difference_image;
  for (const std::filesystem::path& input : {arguments.image, arguments.reference}) require_other_file(output, input);
  require_writable_image(output);
}

}  // namespace

int compare_images(const CompareArguments& arguments) {
  if (!arguments.difference_image.empty()) require_writable(arguments);
  const glint::Image image = glint::read_image(arguments.image);
  const glint::Image reference = glint::read_image(arguments.reference);
  const auto difference = glint::compare(image, reference);
  if (!difference) {
    throw glint::IoError(arguments.image,
                         "has " + std::to_string(image.width()) + "x" + std::to_string(image.height()) +
                             " pixels, but " + arguments.reference.string() + " has " +
                             std::to_string(reference.width()) + "x" + std::to_string(reference.height()));
  }
  bool holds =
      report("mean ratio", difference->mean_ratio, std::abs(difference->mean_ratio - 1), arguments.max_mean_error);
  std::printf("%-12s %.6g\n", "MSE", difference->mse);
  holds &= report("RMSE", difference->rmse, difference->rmse, arguments.max_rmse);
  holds &= report("relMSE", difference->relmse, difference->relmse, arguments.max_relmse);
  holds &= report("off > 0.01", difference->share_above, difference->share_above, arguments.max_share);
  std::printf("%-12s %.6g\n", "largest", difference->max_abs);
  if (!arguments.difference_image.empty()) {
    glint::write_image(absolute_difference(image, reference), arguments.difference_image);
  }
  return holds ? 0 : 1;
}
