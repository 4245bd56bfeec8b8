// SPDX-License-Identifier: MIT
#pragma once
#include <glint/io/scene_file.hpp>

#include "commands.hpp"

/// Reads a scene, and prints its warnings. A unit of its own, for it takes the compiler long.
glint::SceneFile read_scene(const SceneArguments& arguments);
