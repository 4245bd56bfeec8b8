// SPDX-License-Identifier: MIT
#include <glint/render/render.hpp>

#include "render_job.hpp"

glint::RenderReport render(const RenderJob& job, const glint::Direct& integrator) {
  return job.scene.visit([&](const auto& scene) {
    return glint::render(scene, job.camera, integrator, job.film, job.options, job.executor, job.sequence);
  });
}
