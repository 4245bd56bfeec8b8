// SPDX-License-Identifier: MIT
#include <glint/integrator/light_search.hpp>  // first, so the header proves it stands alone

#include <integrator/transport_rooms.hpp>
#include <support/catch.hpp>

#include <glint/bsdf/mirror.hpp>

namespace test_integrator_light_search {

using glint::Arrival;
using glint::LightSearch;
using glint::LightStrategy;
using glint::Rgb;

TEST_CASE("light search: light met by chance counts once over both strategies", "[integrator][light_search]") {
  // From the floor's center straight up to the middle of the lamp: by the cosine, a density of 1 / π.
  const FloorBelowLamp floor;
  const auto scene = floor.scene();
  const auto lamp = scene.interact({.origin = {0, 0.01F, 0}, .direction = {0, 1, 0}});
  REQUIRE(lamp);
  const Arrival arrival{{0, 0, 0}, {0, 1, 0}, glint::inv_pi<float>, true};
  const float light_pdf = surface_pdf(scene.light(0), arrival.from, lamp->surface);
  const float found = LightSearch{}.found_light(scene, *lamp, arrival).g;
  CHECK(found == Approx(glint::power_heuristic(glint::inv_pi<float>, light_pdf)));
  CHECK(found + glint::power_heuristic(light_pdf, glint::inv_pi<float>) == Approx(1));
  CHECK(LightSearch{LightStrategy::NextEvent}.found_light(scene, *lamp, arrival) == Rgb{0});
  CHECK(LightSearch{LightStrategy::NextEvent}.found_light(scene, *lamp, Arrival{}) == Rgb{1});  // seen directly
}

TEST_CASE("light search: lights are not looked for from mirrors, nor by those who walk", "[integrator][light_search]") {
  CHECK(LightSearch{}.looks_from(glint::Interaction<glint::Lambertian>{}));
  CHECK_FALSE(LightSearch{}.looks_from(glint::Interaction<glint::Mirror>{}));
  CHECK_FALSE(LightSearch{LightStrategy::RandomWalk}.looks_from(glint::Interaction<glint::Lambertian>{}));
}

}  // namespace test_integrator_light_search
