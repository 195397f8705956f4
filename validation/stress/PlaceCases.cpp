// Position and scale of scenes, transforms of nodes, and positions, strengths, shapes and animation of lights.
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "validation/stress/StressCase.h"
#include "validation/stress/StressScene.h"

namespace tessera::validation {

namespace {

frame::FrameSettings settingsOf(glm::ivec2 sizePixels = {64, 45}) {
    frame::FrameSettings settings;
    settings.sizePixels = sizePixels;
    settings.display = false;
    return settings;
}

std::vector<StressPicture> farPictures(StressEffort) {
    std::vector<StressPicture> pictures{{"at the origin", stressScene(), settingsOf()}};
    for (int exponent = 3; exponent <= 7; ++exponent) {
        const double metres = std::pow(10.0, exponent);
        scenes::Scene scene = stressScene();
        moveScene(scene, 1.0, glm::dvec3(metres, -metres, metres));
        pictures.push_back({fmt::format("at 1e{} m", exponent), std::move(scene), settingsOf(), 0});
    }
    return pictures;
}

std::vector<StressPicture> scaledPictures(StressEffort) {
    std::vector<StressPicture> pictures;
    for (int exponent = -4; exponent <= 4; ++exponent) {
        scenes::Scene scene = stressScene();
        moveScene(scene, std::pow(10.0, exponent), glm::dvec3(0.0));
        pictures.push_back({fmt::format("1e{} times as large", exponent), std::move(scene), settingsOf()});
    }
    return pictures;
}

struct NamedTransform {
    const char* what;
    glm::dmat4 change;
};

std::vector<StressPicture> transformedPictures(StressEffort) {
    const auto scaled = [](double x, double y, double z) { return glm::scale(glm::dmat4(1.0), glm::dvec3(x, y, z)); };
    glm::dmat4 sheared(1.0);
    sheared[1] = {0.8, 1.0, 0.3, 0.0};
    const NamedTransform transforms[] = {{"stretched 100:1", scaled(1.0, 0.01, 1.0)},
                                         {"stretched 1:10", scaled(0.3, 1.5, 0.15)},
                                         {"mirrored", scaled(-1.0, 1.0, 1.0)},
                                         {"mirrored three times", scaled(-1.0, -1.0, -0.7)},
                                         {"sheared", sheared},
                                         {"singular, flat", scaled(1.0, 0.0, 1.0)},
                                         {"singular, a line", scaled(1.0, 0.0, 0.0)},
                                         {"singular, a point", scaled(0.0, 0.0, 0.0)}};
    std::vector<StressPicture> pictures;
    for (const NamedTransform& transform : transforms) {
        scenes::Scene scene = stressScene();
        // Flat meshes have front and back at one depth, so only one of them may be visible.
        const bool isFlat = glm::determinant(transform.change) == 0.0;
        for (scenes::Material& material : scene.materials) material.doubleSided = !isFlat;
        // All except the floor, which keeps the image from being empty.
        for (std::size_t i = 1; i < scene.nodes.size(); ++i)
            scene.nodes[i].parentFromNode = scene.nodes[i].parentFromNode * transform.change;
        pictures.push_back({transform.what, std::move(scene), settingsOf()});
    }
    return pictures;
}

/// Lights on the floor at a pixel's centre, a rounding error beside it, and very far away.
std::vector<StressPicture> lightPlaces(StressEffort) {
    std::vector<StressPicture> pictures;
    const auto add = [&](std::string what, const scenes::Light& light) {
        scenes::Scene scene = stressFloor();
        scene.lights = {stressLight({0.3, 1.0, 0.2}, 1.0f), light};
        pictures.push_back({std::move(what), std::move(scene), settingsOf({33, 33})});
    };
    for (const double metres : {0.0, 1e-6, 1e-3}) // the middle pixel of 33 looks at the origin
        add(fmt::format("a light {:g} m above the surface", metres), stressLight({0.0, metres, 0.0}, 1e-4f));
    add("a light 1e-6 m below the surface", stressLight({0.0, -1e-6, 0.0}, 1.0f));
    add("a light 1e6 m away", stressLight({6e5, 8e5, 0.0}, 1e12f));
    return pictures;
}

/// A metre of surface viewed from far away with a narrow field of view or parallel rays, and a light close above it.
std::vector<StressPicture> farEyes(StressEffort) {
    std::vector<StressPicture> pictures;
    const auto floor = [&](double eyeMetres, double lampMetres) {
        scenes::Scene scene = stressFarFloor(eyeMetres);
        scene.lights = {stressLight({0.013, lampMetres, 0.007}, 1.0f)};
        const std::string what = fmt::format("a lamp {:g} m above a floor, from {:g} m", lampMetres, eyeMetres);
        pictures.push_back({what, std::move(scene), settingsOf()});
    };
    for (const double eyeMetres : {1e3, 1e4, 1e5}) floor(eyeMetres, 0.2);
    for (const double eyeMetres : {10.0, 1e3}) floor(eyeMetres, 1e-3);
    floor(1e4, 0.2);
    scenes::Camera& parallel = pictures.back().scene.cameras[0];
    parallel.projection = scenes::Projection::Orthographic;
    parallel.halfHeightMetres = 0.45;
    pictures.back().what += ", parallel rays";
    pictures.push_back({"300 lights around a ball, from 1e3 m", stressFarBall(1e3, 300), settingsOf()});
    return pictures;
}

std::vector<StressPicture> lightStrengths(StressEffort) {
    std::vector<StressPicture> pictures;
    for (const int exponent : {-20, -10, 0, 10, 20}) {
        scenes::Scene scene = stressScene();
        for (scenes::Light& light : scene.lights) light.intensity *= float(std::pow(10.0, exponent));
        pictures.push_back({fmt::format("intensities times 1e{}", exponent), std::move(scene), settingsOf()});
    }
    return pictures;
}

std::vector<StressPicture> lightShapes(StressEffort) {
    std::vector<StressPicture> pictures;
    const auto add = [&](const char* what, auto change) {
        scenes::Scene scene = stressScene();
        change(scene.lights[1]); // the spot; the point light stays as it is
        pictures.push_back({what, std::move(scene), settingsOf()});
    };
    add("a cone of 0", [](scenes::Light& light) { light.outerConeRadians = 0.0f; });
    add("a cone of 180 degrees to each side", [](scenes::Light& light) { light.outerConeRadians = 3.14159265f; });
    add("a cone without a soft edge", [](scenes::Light& light) { light.innerConeRadians = light.outerConeRadians; });
    add("a range of 0", [](scenes::Light& light) { light.rangeMetres = 0.0f; });
    add("a range of 1e-6 m", [](scenes::Light& light) { light.rangeMetres = 1e-6f; });
    add("a range of 1e6 m", [](scenes::Light& light) { light.rangeMetres = 1e6f; });
    return pictures;
}

/// A light's animation is a closed-form function of time, so whole periods later it must be at the same position.
std::vector<StressPicture> animatedPictures(StressEffort) {
    std::vector<StressPicture> pictures;
    for (const scenes::LightAnimationKind kind :
         {scenes::LightAnimationKind::Orbit, scenes::LightAnimationKind::Wobble, scenes::LightAnimationKind::Path}) {
        const std::size_t first = pictures.size();
        for (const double periods : {0.0001, 1.0001, 1000.0001, 1000000.0001}) {
            scenes::Scene scene = stressScene();
            scenes::LightAnimation animation;
            animation.kind = kind;
            animation.periodSeconds = 0.5;
            animation.centerWS = {0.0, 2.0, 0.0};
            animation.amplitudeMetres = {0.5, 0.25, 1.0};
            animation.pointsWS = {{1.0, 2.5, 1.5}, {-1.0, 2.0, 1.0}, {0.0, 3.0, -1.0}};
            scene.lights[0].animation = animation;
            frame::FrameSettings settings = settingsOf();
            settings.timeSeconds = animation.periodSeconds * periods;
            StressPicture picture{fmt::format("animation {} after {:.12g} periods", int(kind), periods),
                                  std::move(scene), settings};
            if (periods > 1.0) picture.sameAs = first;
            pictures.push_back(std::move(picture));
        }
    }
    return pictures;
}

} // namespace

void addPlaceCases(std::vector<StressCase>& cases) {
    const auto add = [&cases](const char* name, const char* holds, auto pictures) {
        cases.push_back({name, holds, StressBound::WorstRel, kBallTolerance, kBallReason, {}, pictures});
    };
    add("scene/light_place", "lights on the surface, a millionth of a metre beside it and 1000 km away", &lightPlaces);
    add("scene/light_strength", "intensities from 1e-20 to 1e20", &lightStrengths);
    add("scene/light_shape", "cones of 0 and 180 degrees, ranges of 0 to 1e6 m", &lightShapes);
    cases.push_back({"scene/far",
                     "the scene 1e3 to 1e7 m from the origin looks as it does there",
                     StressBound::RelMse,
                     1e-8,
                     "positions are subtracted in double, which keeps 2e-9 m at 1e7 m",
                     {},
                     &farPictures});
    cases.push_back({"scene/far_eye",
                     "a metre of surface from 10 m to 100 km, a light 1 mm above it",
                     StressBound::WorstRel,
                     1e-3,
                     "rounding moves a surface of 1 m by 5e-7 m, which counts twice for a light at 1 mm",
                     {},
                     &farEyes});
    add("scene/scale", "the scene 1e-4 to 1e4 times as large", &scaledPictures);
    add("scene/transform", "non-uniform, mirrored, sheared and singular transforms", &transformedPictures);
    cases.push_back({"scene/animation",
                     "lights whole periods later, up to a million, are where they were",
                     StressBound::RelMse,
                     1e-8,
                     "time is kept in double: after a million periods a phase is right to 1e-10",
                     {},
                     &animatedPictures});
}

} // namespace tessera::validation
