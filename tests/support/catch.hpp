// SPDX-License-Identifier: MIT
#pragma once

/// Catch2 of either major version: the tests use only what both have.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif
using namespace Catch::Generators;
