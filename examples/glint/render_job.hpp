// SPDX-License-Identifier: MIT
#pragma once
#include <glint/core/tbb_executor.hpp>
#include <glint/film/film.hpp>
#include <glint/integrator/ambient_occlusion.hpp>
#include <glint/integrator/bdpt.hpp>
#include <glint/integrator/direct.hpp>
#include <glint/integrator/intersection_test.hpp>
#include <glint/integrator/light_tracer.hpp>
#include <glint/integrator/normals.hpp>
#include <glint/integrator/path.hpp>
#include <glint/io/scene_file.hpp>
#include <glint/io/scene_settings.hpp>
#include <glint/render/options.hpp>
#include <glint/render/report.hpp>

/// All that rendering a scene file takes but the integrator.
struct RenderJob {
  const glint::AnyLoadedScene& scene;
  const glint::SceneCamera& camera;
  glint::Film<glint::SceneFilter>& film;
  const glint::RenderOptions& options;
  const glint::TbbExecutor& executor;
  const glint::SceneSequence& sequence;
};

// One unit each, for each takes the compiler long.
glint::RenderReport render(const RenderJob& job, const glint::IntersectionTest& integrator);
glint::RenderReport render(const RenderJob& job, const glint::Path& integrator);
glint::RenderReport render(const RenderJob& job, const glint::Direct& integrator);
glint::RenderReport render(const RenderJob& job, const glint::LightTracer& integrator);
glint::RenderReport render(const RenderJob& job, const glint::Bdpt& integrator);
glint::RenderReport render(const RenderJob& job, const glint::AmbientOcclusion& integrator);
glint::RenderReport render(const RenderJob& job, const glint::Normals& integrator);
