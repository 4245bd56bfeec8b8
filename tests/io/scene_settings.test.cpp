// SPDX-License-Identifier: MIT
#include <glint/io/scene_settings.hpp>  // first, so the header proves it stands alone

#include <string>
#include <vector>

#include <support/catch.hpp>
#include <support/json_text.hpp>

namespace test_io_scene_settings {

namespace {

using glint::IntegratorSettings;
using glint::IntersectionTest;
using glint::JsonObject;
using glint::Path;
using glint::PointLight;
using glint::Rgb;
using glint::Vec2;
using glint::Vec2i;
using glint::testing::json_error;
using glint::testing::JsonText;

IntegratorSettings integrator_of(const char* text, bool scene_has_lights = false) {
  JsonText json(text);
  auto result = read_integrator(json.object(), scene_has_lights);
  CHECK(json.source.warnings.empty());
  return result;
}

glint::FilmSettings film_of(const char* text) {
  JsonText json(text);
  const auto result = read_film(json.object());
  CHECK(json.source.warnings.empty());
  return result;
}

glint::SceneCamera camera_of(const char* text) {
  JsonText json(text);
  const auto result = read_camera(json.object());
  CHECK(json.source.warnings.empty());
  return result;
}

const auto read_any_integrator = [](JsonObject object) { return read_integrator(std::move(object), false); };

}  // namespace

TEST_CASE("scene settings: an integrator is a path tracer unless it says otherwise", "[io][scene]") {
  const auto settings = integrator_of("{}");
  REQUIRE(settings.integrator.get_if<Path>() != nullptr);
  CHECK(settings.integrator.get_if<Path>()->max_depth == 12);
  CHECK(settings.integrator.get_if<Path>()->roulette_below == 0.1F);
  CHECK(settings.integrator.get_if<Path>()->strategy == glint::LightStrategy::Mis);
  CHECK(settings.samples == 32);
  CHECK(settings.point_lights.empty());
}

TEST_CASE("scene settings: intersection_test brings 1 watt at (0, 5, 0), 8 samples and depth 16", "[io][scene]") {
  const auto settings = integrator_of(R"({"type": "intersection_test"})");
  REQUIRE(settings.integrator.get_if<IntersectionTest>() != nullptr);
  CHECK(settings.integrator.get_if<IntersectionTest>()->max_depth == 16);
  CHECK(settings.integrator.get_if<IntersectionTest>()->falloff == glint::Falloff::InverseSquare);
  CHECK(settings.samples == 8);
  CHECK(settings.point_lights == std::vector{PointLight::from_flux({0, 5, 0}, 1)});
}

TEST_CASE("scene settings: every key of an integrator counts", "[io][scene]") {
  const auto direct = integrator_of(R"({"type": "intersection_test", "point_light_position": [1, 2, 3],
    "point_light_flux": [4, 5, 6], "max_depth": 3, "spp": 2.0, "falloff": "square"})");
  CHECK(direct.integrator.get_if<IntersectionTest>()->max_depth == 3);
  CHECK(direct.integrator.get_if<IntersectionTest>()->falloff == glint::Falloff::Square);
  CHECK(direct.samples == 2);
  CHECK(direct.point_lights == std::vector{PointLight::from_flux({1, 2, 3}, {4, 5, 6})});
  const auto path = integrator_of(R"({"type": "path", "max_depth": 5, "spp": 7, "rr_threshold": 0.25})");
  CHECK(path.integrator.get_if<Path>()->max_depth == 5);
  CHECK(path.integrator.get_if<Path>()->roulette_below == 0.25F);
  CHECK(path.samples == 7);
}

TEST_CASE("scene settings: the flux of a point light is 4 pi times its intensity", "[io][scene]") {
  const auto lights = integrator_of(R"({"point_lights": [{"position": [0, 1, 0], "flux": [12.566371, 0, 0]},
    {"position": [2, 0, 0], "intensity": [3, 2, 1]}]})")
                          .point_lights;
  REQUIRE(lights.size() == 2);
  CHECK(lights[0].position == glint::Vec3<float>(0, 1, 0));
  CHECK(lights[0].intensity.r == Approx(1).epsilon(1e-6));
  CHECK(lights[1] == PointLight{{2, 0, 0}, {3, 2, 1}});
}

TEST_CASE("scene settings: named point lights replace the default one, and join one named by its own keys",
          "[io][scene]") {
  const std::string light = R"({"position": [0, 1, 0], "flux": [1, 1, 1]})";
  CHECK(integrator_of((R"({"type": "intersection_test", "point_lights": [)" + light + "]}").c_str())
            .point_lights.size() == 1);
  CHECK(
      integrator_of(
          (R"({"type": "intersection_test", "point_light_flux": [2, 2, 2], "point_lights": [)" + light + "]}").c_str())
          .point_lights.size() == 2);
}

TEST_CASE("scene settings: where the scene lists lights there is no default one", "[io][scene]") {
  CHECK(integrator_of(R"({"type": "intersection_test"})", true).point_lights.empty());
  CHECK(integrator_of(R"({"type": "intersection_test", "point_light_flux": [1, 1, 1]})", true).point_lights.size() ==
        1);
}

TEST_CASE("scene settings: every spelling of a light strategy", "[io][scene]") {
  using glint::LightStrategy;
  const auto strategy = [](const std::string& name) {
    return integrator_of((R"({"profile": ")" + name + "\"}").c_str()).integrator.get_if<Path>()->strategy;
  };
  for (const char* const name : {"MIS", "MultipleImportanceSampling"}) CHECK(strategy(name) == LightStrategy::Mis);
  for (const char* const name : {"NEE", "NextEventEstimation"}) CHECK(strategy(name) == LightStrategy::NextEvent);
  for (const char* const name : {"RW", "RandomWalk"}) CHECK(strategy(name) == LightStrategy::RandomWalk);
}

TEST_CASE("scene settings: bounces are unlimited and light is not clamped unless asked for", "[io][scene]") {
  CHECK(integrator_of("{}").integrator.get_if<Path>()->limits == glint::BounceLimits{});
  CHECK_FALSE(integrator_of("{}").integrator.get_if<Path>()->clamp.is_on());
  const auto settings = integrator_of(R"({"max_diffuse": 0, "max_glossy": 3, "max_transmissive": 8,
    "clamp_direct": 20, "clamp_indirect": 2.5})");
  const Path& path = *settings.integrator.get_if<Path>();
  CHECK(path.limits == glint::BounceLimits{.diffuse = 0, .glossy = 3, .transmissive = 8});
  CHECK(path.clamp == glint::LightClamp{.direct = 20, .indirect = 2.5F});
  CHECK(json_error(R"({"max_glossy": -1})", read_any_integrator) ==
        "/x/max_glossy: found -1, expected an integer from 0 up");
  CHECK(json_error(R"({"clamp_indirect": 0})", read_any_integrator) ==
        "/x/clamp_indirect: found 0, expected a number above 0");
}

TEST_CASE("scene settings: a film may name a tone curve", "[io][scene]") {
  CHECK(film_of("{}").tone == glint::ToneCurve::Clip);
  CHECK(film_of(R"({"tone": "agx"})").tone == glint::ToneCurve::Agx);
  CHECK(json_error(R"({"tone": "aces"})", glint::read_film) ==
        "/x/tone: found \"aces\", expected one of \"clip\", \"filmic\", \"hable\", \"agx\"");
}

TEST_CASE("scene settings: direct light takes a depth and a strategy", "[io][scene]") {
  const auto plain = integrator_of(R"({"type": "direct"})").integrator;
  REQUIRE(plain.get_if<glint::Direct>() != nullptr);
  CHECK(plain.get_if<glint::Direct>()->max_depth == 12);
  CHECK(plain.get_if<glint::Direct>()->strategy == glint::LightStrategy::Mis);
  const auto keys = integrator_of(R"({"type": "direct", "max_depth": 3, "profile": "RW"})").integrator;
  CHECK(keys.get_if<glint::Direct>()->max_depth == 3);
  CHECK(keys.get_if<glint::Direct>()->strategy == glint::LightStrategy::RandomWalk);
}

TEST_CASE("scene settings: photon is rendered by path, and says so", "[io][scene]") {
  JsonText json(R"({"type": "photon", "spp": 128, "n_photons": 1000, "n_iterations": 4, "n_near_photons": 8})");
  json.source.strict = true;  // not an oddity of the file
  const auto settings = read_integrator(json.object("/integrator"), false);
  CHECK(settings.integrator.get_if<Path>() != nullptr);
  CHECK(settings.samples == 128);
  CHECK(json.source.warnings == std::vector<std::string>{"scene.json:/integrator/type: rendered with \"path\", as "
                                                         "this integrator is not available"});
}

TEST_CASE("scene settings: paths may begin at the camera, at lights, or at both, or not be there at all",
          "[io][scene]") {
  const auto read = [](const char* text) { return read_any_integrator(JsonText(text).object("/x")).integrator; };
  const auto both = read(R"({"type": "bdpt", "max_depth": 5, "rr_threshold": 0.2, "profile": "MIS"})");
  REQUIRE(both.get_if<glint::Bdpt>() != nullptr);
  CHECK(both.get_if<glint::Bdpt>()->max_depth == 5);
  CHECK(both.get_if<glint::Bdpt>()->roulette_below == 0.2F);
  const auto lights = read(R"({"type": "light_tracer", "max_depth": 3})");
  REQUIRE(lights.get_if<glint::LightTracer>() != nullptr);
  CHECK(lights.get_if<glint::LightTracer>()->max_depth == 3);
  const auto sky = read(R"({"type": "ambient_occlusion", "distance": 2})");
  REQUIRE(sky.get_if<glint::AmbientOcclusion>() != nullptr);
  CHECK(sky.get_if<glint::AmbientOcclusion>()->distance == 2);
  CHECK(read(R"({"type": "normals"})").get_if<glint::Normals>() != nullptr);
  const auto walk = read(R"({"type": "random_walk"})");
  REQUIRE(walk.get_if<Path>() != nullptr);
  CHECK(walk.get_if<Path>()->strategy == glint::LightStrategy::RandomWalk);
}

TEST_CASE("scene settings: a wrong integrator is an error that tells what was found and expected", "[io][scene]") {
  const auto error = [](const char* text) { return json_error(text, read_any_integrator); };
  CHECK(error(R"({"type": "pth"})") ==
        "/x/type: found \"pth\", expected one of \"intersection_test\", \"path\", \"random_walk\", \"direct\", "
        "\"light_tracer\", \"bdpt\", \"ambient_occlusion\", \"normals\", \"photon\"; did you mean \"path\"?");
  CHECK(error(R"({"type": 3})") == "/x/type: found 3, expected a string");
  CHECK(error(R"({"spp": -4})") == "/x/spp: found -4, expected an integer from 1 to 16777216");
  CHECK(error(R"({"spp": 0})") == "/x/spp: found 0, expected an integer from 1 to 16777216");
  CHECK(error(R"({"spp": 1.5})") == "/x/spp: found 1.5, expected an integer from 1 to 16777216");
  CHECK(error(R"({"max_depth": 0})") == "/x/max_depth: found 0, expected an integer from 1 up");
  CHECK(error(R"({"rr_threshold": -1})") == "/x/rr_threshold: found -1, expected a number from 0 up");
  CHECK(error(R"({"falloff": "cubic"})") ==
        "/x/falloff: found \"cubic\", expected one of \"inverse_square\", \"none\", \"square\"");
  CHECK(error(R"({"point_light_flux": [1, -1, 1]})") ==
        "/x/point_light_flux: found [1,-1,1], expected three numbers from 0 up");
  CHECK(error(R"({"point_lights": [{"position": [0, 0, 0]}]})") ==
        "/x/point_lights/0: a point light has either \"flux\" or \"intensity\"");
  CHECK(error(R"({"point_lights": [{"flux": [1, 1, 1]}]})") == "/x/point_lights/0: the key \"position\" is missing");
}

TEST_CASE("scene settings: an empty film is 600 by 600 pixels with a box filter", "[io][scene]") {
  const auto film = film_of("{}");
  CHECK(film.resolution == Vec2i(600, 600));
  REQUIRE(film.filter.get_if<glint::BoxFilter>() != nullptr);
  CHECK(film.filter.radius() == 0.5F);
}

TEST_CASE("scene settings: resolutions may be reals, and blocks are of no concern", "[io][scene]") {
  CHECK(film_of(R"({"resolution": [320.0, 240], "block_side_length": 16})").resolution == Vec2i(320, 240));
}

TEST_CASE("scene settings: every filter with its defaults and keys", "[io][scene]") {
  const auto filter = [](const std::string& text) { return film_of((R"({"filter": )" + text + "}").c_str()).filter; };
  CHECK(filter("{}").get_if<glint::BoxFilter>() != nullptr);
  CHECK(filter(R"({"type": "box", "radius": 2})").radius() == 2);
  CHECK(filter(R"({"type": "tent", "radius": 1})").get_if<glint::TentFilter>() != nullptr);
  const auto gaussian = filter(R"({"type": "gaussian", "radius": 1.5})");
  REQUIRE(gaussian.get_if<glint::GaussianFilter>() != nullptr);
  CHECK(gaussian.get_if<glint::GaussianFilter>()->alpha == 2);
  CHECK(gaussian.radius() == 1.5F);
  CHECK(filter(R"({"type": "gaussian", "alpha": 3})").get_if<glint::GaussianFilter>()->alpha == 3);
  const auto mitchell = filter(R"({"type": "mitchell", "radius": 2})");
  REQUIRE(mitchell.get_if<glint::MitchellFilter>() != nullptr);
  CHECK(mitchell.get_if<glint::MitchellFilter>()->b == Approx(1.0 / 3));
  CHECK(mitchell.get_if<glint::MitchellFilter>()->c == Approx(1.0 / 3));
  CHECK(filter(R"({"type": "mitchell", "B": 0, "C": 0.5})").get_if<glint::MitchellFilter>()->c == 0.5F);
}

TEST_CASE("scene settings: a wrong film is an error that tells what was found and expected", "[io][scene]") {
  const auto error = [](const char* text) { return json_error(text, glint::read_film); };
  CHECK(error(R"({"resolution": 512})") == "/x/resolution: found 512, expected [width, height]");
  CHECK(error(R"({"resolution": [512]})") == "/x/resolution: found an array of 1, expected [width, height]");
  CHECK(error(R"({"resolution": [0, 4]})") == "/x/resolution/0: found 0, expected an integer from 1 to 65536");
  CHECK(error(R"({"resolution": [4, 4.5]})") == "/x/resolution/1: found 4.5, expected an integer from 1 to 65536");
  CHECK(error(R"({"resolution": [65536, 65536]})") ==
        "/x/resolution: found [65536,65536], expected at most 268435456 pixels in all");
  CHECK(error(R"({"filter": "box"})") == "/x/filter: found \"box\", expected an object");
  CHECK(error(R"({"filter": {"radius": 9}})") == "/x/filter/radius: found 9, expected a number above 0, 8 at most");
  CHECK(error(R"({"filter": {"type": "bos"}})") ==
        "/x/filter/type: found \"bos\", expected one of \"box\", \"tent\", "
        "\"gaussian\", \"mitchell\"; did you mean \"box\"?");
}

TEST_CASE("scene settings: an empty camera stands at (0, 0, 1) and looks at the origin, 45 degrees high",
          "[io][scene]") {
  const auto camera = camera_of("{}");
  REQUIRE(camera.get_if<glint::Perspective>() != nullptr);
  CHECK(*camera.get_if<glint::Perspective>() == glint::Perspective{});
}

TEST_CASE("scene settings: fov is the full vertical angle in degrees", "[io][scene]") {
  // tan 45° = 1: at aspect 2 the window at distance 1 reaches from −2 to 2 and from −1 to 1.
  const auto camera =
      camera_of(R"({"position": [1, 2, 3], "look_at": [1, 2, 0], "ref_up": [0, 3, 0], "fov": 90, "focal_length": 1})");
  const auto rays = camera.rays(2.0F);
  const Vec2<float> lens{0.5F, 0.5F};
  const auto upper_right = rays.ray(Vec2<float>{1, 1}, lens);
  CHECK(upper_right.origin == glint::Vec3<float>(1, 2, 3));
  const auto direction = upper_right.direction / -upper_right.direction.z;
  CHECK(direction.x == Approx(2));
  CHECK(direction.y == Approx(1));
  const auto lower_left = rays.ray(Vec2<float>{0, 0}, lens).direction;
  CHECK(lower_left.x / -lower_left.z == Approx(-2));
  CHECK(lower_left.y / -lower_left.z == Approx(-1));
}

TEST_CASE("scene settings: other cameras have their own keys", "[io][scene]") {
  const auto lens = camera_of(R"({"type": "thin_lens", "position": [0, 0, 5], "lens_radius": 0.25})");
  REQUIRE(lens.get_if<glint::ThinLens>() != nullptr);
  CHECK(lens.get_if<glint::ThinLens>()->lens_radius == 0.25F);
  CHECK(lens.get_if<glint::ThinLens>()->focus_distance == 5);  // on the target
  CHECK(camera_of(R"({"type": "thin_lens", "focus_distance": 3})").get_if<glint::ThinLens>()->focus_distance == 3);
  CHECK(camera_of(R"({"type": "orthographic", "height": 4})").get_if<glint::Orthographic>()->height == 4);
  CHECK(camera_of(R"({"type": "panoramic", "position": [1, 2, 3]})").get_if<glint::Panoramic>()->eye ==
        glint::Vec3<float>(1, 2, 3));
}

TEST_CASE("scene settings: a wrong camera is an error that tells what was found and expected", "[io][scene]") {
  const auto error = [](const char* text) { return json_error(text, glint::read_camera); };
  CHECK(error(R"({"fov": 180})") == "/x/fov: found 180, expected an angle between 0 and 180 degrees");
  CHECK(error(R"({"fov": 0})") == "/x/fov: found 0, expected an angle between 0 and 180 degrees");
  CHECK(error(R"({"position": [0, 0, 0]})") == "/x: \"position\" and \"look_at\" are the same point");
  CHECK(error(R"({"ref_up": [0, 1]})") == "/x/ref_up: found an array of 2, expected an array of 3 numbers");
  CHECK(error(R"({"type": "fisheye"})") ==
        "/x/type: found \"fisheye\", expected one of \"perspective\", "
        "\"thin_lens\", \"orthographic\", \"panoramic\"");
  CHECK(error(R"({"type": "thin_lens", "focus_distance": 0})") ==
        "/x/focus_distance: found 0, expected a number above 0");
}

TEST_CASE("scene settings: samplers and accelerators", "[io][scene]") {
  JsonText sampler(R"({"type": "stratified", "seed": 7})");
  const auto settings = read_sampler(sampler.object());
  CHECK(settings.kind == glint::SamplerKind::Stratified);
  CHECK(settings.seed == 7);
  const auto sequence = sequence_of(settings, 16);
  REQUIRE(sequence.get_if<glint::Stratified>() != nullptr);
  CHECK(sequence.get_if<glint::Stratified>()->samples_per_pixel == 16);
  CHECK(sequence.get_if<glint::Stratified>()->seed == 7);
  CHECK(glint::sequence_of({.seed = 3}, 20) == glint::SceneSequence(glint::ZSobol{.samples_per_pixel = 20, .seed = 3}));
  const auto sequence_named = [](const std::string& type) {
    JsonText named(R"({"seed": 5, "type": ")" + type + "\"}");
    return sequence_of(read_sampler(named.object()), 9);
  };
  CHECK(sequence_named("independent") == glint::SceneSequence(glint::Independent{.seed = 5}));
  CHECK(sequence_named("halton") == glint::SceneSequence(glint::Halton{.seed = 5}));
  CHECK(sequence_named("sobol") == glint::SceneSequence(glint::Sobol{.seed = 5}));
  CHECK(sequence_named("zsobol") == glint::SceneSequence(glint::ZSobol{.samples_per_pixel = 9, .seed = 5}));
  CHECK(json_error(R"({"type": "sobl"})", glint::read_sampler) ==
        "/x/type: found \"sobl\", expected one of \"independent\", \"stratified\", \"halton\", \"sobol\", \"zsobol\"; "
        "did you mean \"sobol\"?");

  JsonText accelerator(R"({"builder": "sweep_sah"})");
  CHECK(read_accelerator(accelerator.object()).builder == glint::BuilderKind::SweepSah);
  JsonText width(R"({"builder": "ploc", "width": 4})");
  CHECK(read_accelerator(width.object("/x")).builder == glint::BuilderKind::Morton);
  REQUIRE(width.source.warnings.size() == 1);
  CHECK(width.source.warnings[0] == "scene.json:/x/width: has no effect: nodes have up to 8 children");
  CHECK(json_error(R"({"width": 3})", glint::read_accelerator) == "/x/width: found 3, expected 2, 4 or 8");
  CHECK(json_error(R"({"builder": "kd_tree"})", glint::read_accelerator) ==
        "/x/builder: found \"kd_tree\", expected one of \"median\", \"morton\", \"ploc\", \"sah\", \"sweep_sah\", "
        "\"spatial\", \"best\"");
}

}  // namespace test_io_scene_settings
