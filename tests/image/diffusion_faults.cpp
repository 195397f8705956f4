// Faults of the diffusion passes that closed forms detect.

#include "tests/image/DiffusionTest.h"
#include "tests/support/ShaderMutant.h"

namespace tessera {
namespace {

using engine::Technique;
using namespace test;

/// A figure measured with the shaders under test, and its limit.
struct Measured {
    double found, most;
};

class DiffusionFaults : public DiffusionTest {
public:
    using Measure = Measured (DiffusionFaults::*)(const shader::SourceTree&);
    struct Fault {
        const char* what;
        const char* file;
        const char* from;
        const char* to;
        Measure seenBy;
    };

    Measured step(const shader::SourceTree& shaders) { return {stepError(256, {}, shaders).l2, 6.5e-3}; }
    Measured coarseStep(const shader::SourceTree& shaders) { return {stepError(128, {}, shaders).l2, 0.017}; }
    Measured twoWidths(const shader::SourceTree& shaders) {
        return {std::max(stepErrorOf(0.71, 17.9, shaders), stepErrorOf(2.6, 5.0, shaders)), 2e-3};
    }
    Measured slantedStep(const shader::SourceTree& shaders) {
        return {stepErrorOf(5.0, 9.0, shaders, {{0.6, 0.0}, {0.3, 0.6}}), 3e-3};
    }
    /// The texture shifts by two and a half columns per row: interpolation blurs light along u by a quarter of the
    /// width of the narrower Gaussian, instead of a tenth.
    Measured steeplySlantedStep(const shader::SourceTree& shaders) {
        return {stepErrorOf(12.0, 20.0, shaders, {{0.4, 0.0}, {0.5, 0.2}}), 3e-3};
    }
    Measured stepOfFewerTexelsAlongX(const shader::SourceTree& shaders) {
        const auto stretch = [](scenes::Scene& scene) { mapTexture(scene, {{0.5, 0.0}, {0.0, 1.0}}); };
        return {stepError(512, stretch, shaders).l2, 7e-3};
    }
    Measured stepOfFewerTexelsAcrossV(const shader::SourceTree& shaders) {
        const auto stretch = [](scenes::Scene& scene) { mapTexture(scene, {{0.0, 0.5}, {1.0, 0.0}}); };
        return {stepError(512, stretch, shaders).l2, 7e-3};
    }
    /// Uniform light on a sphere of six charts of albedo one half: the largest error of a pixel.
    Measured evenLight(const shader::SourceTree& shaders) {
        scenes::Scene scene = sphereScene(0.03, 16);
        for (glm::vec3& normal : scene.meshes[0].normalsOS) normal = glm::vec3(0.0f, 1.0f, 0.0f);
        scene.materials[0].baseColor = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
        scene.lights[0].directionWS = {0.0, -1.0, 0.0};
        scene.lights[0].intensity = 1.0f;
        const engine::RenderedFrame frame = drawn(scene, shaders);
        double worst = 0.0;
        for (std::size_t i = 0; i < frame.radiance.size(); i += 4)
            if (frame.radiance[i + 3] != 0.0f) worst = std::max(worst, std::abs(double(frame.radiance[i]) - 0.5));
        return {worst, 1e-3};
    }
    /// The unlit side of a sphere far larger than the diffusion widths.
    Measured night(const shader::SourceTree& shaders) {
        scenes::Scene scene = sphereScene(0.1, 16);
        scene.lights[0].directionWS = glm::normalize(glm::dvec3(0.9, 0.7, 1.0)); // towards the camera
        const engine::RenderedFrame frame = drawn(scene, shaders);
        const std::size_t middle = 4 * (100 * 200 + 100);
        return {double(frame.radiance[middle]), 1e-6};
    }

private:
    engine::RenderedFrame drawn(scenes::Scene& scene, const shader::SourceTree& shaders) {
        scene.background = glm::vec3(0.0f);
        frame::FrameSettings settings = withDiffusion(withoutShadows(ofSize(200, 200)), 128);
        return engine::Renderer(context(), scene, shaders).render(Technique::Deferred, settings);
    }
};

TEST_SWEEP(DiffusionFaults, everyFaultIsSeenByAClosedForm) {
    const std::vector<Fault> faults{
        {"one Gaussian's weight", "passes/diffusion_blur.frag", "sum = vec4(constants.weight.rgb * result, 1.0);",
         "sum = vec4(constants.weight.rgb * result * (abs(constants.weight.r - 0.078) < 0.01 ? 0.8 : 1.0), 1.0);",
         &DiffusionFaults::step},
        {"millimetres taken for metres", "passes/diffusion_blur.frag", "    precise float narrow = variance",
         "    variance *= 1e6;\n    precise float narrow = variance", &DiffusionFaults::step},
        {"stretch ignored", "passes/diffusion_blur.frag", "constants.gaussian.y == 0.0 ? own.x : own.y", "own.y",
         &DiffusionFaults::stepOfFewerTexelsAlongX},
        {"rows taken for as far apart as columns", "passes/diffusion_blur.frag",
         "constants.gaussian.y == 0.0 ? own.x : own.y", "own.x", &DiffusionFaults::stepOfFewerTexelsAcrossV},
        {"light diffused farther along v", "passes/diffusion_blur.frag", "    precise float narrow = variance",
         "    variance *= 1.0 + 0.4 * constants.gaussian.y;\n    precise float narrow = variance",
         &DiffusionFaults::stepOfFewerTexelsAcrossV},
        {"dilation off", "passes/filled_light.glsl", "if (chart == 0.0) return filled;",
         "if (chart <= 0.0) return filled;", &DiffusionFaults::evenLight},
        {"the albedo taken twice", "lib/raster/diffused_light.glsl", "powerOf(surface.albedo, 1.0 - material.mixed.z)",
         "powerOf(surface.albedo, 1.0)", &DiffusionFaults::evenLight},
        {"back faces lit", "passes/diffusion_light.frag", "    entering = vec4(light, 1.0);",
         "    surface.normalLS = -surface.normalLS;\n"
         "    light += shadeSurface(surface, viewpoint, gl_FragCoord.xy);\n"
         "    entering = vec4(light, 1.0);",
         &DiffusionFaults::night},
        {"channels of the profile swapped", "passes/diffusion_blur.frag", "constants.weight.rgb * result",
         "constants.weight.bgr * result", &DiffusionFaults::step},
        {"taps that end early", "passes/diffusion_blur.frag", "ceil(DIFFUSION_REACH * perStep / float(apart))",
         "ceil(2.0 * perStep / float(apart))", &DiffusionFaults::twoWidths},
        {"taps far apart where light is not smooth", "passes/diffusion_blur.frag", "bool isFine = !isSmooth",
         "bool isFine = false", &DiffusionFaults::twoWidths},
        {"a slanted texture taken for a straight one", "passes/diffusion_blur.frag",
         "precise float aside = shear * float(offset);", "precise float aside = 0.0;", &DiffusionFaults::slantedStep},
        {"light that slanted rows show along u counted as none", "passes/diffusion_blur.frag", "(1.0 + askew * askew)",
         "1.0", &DiffusionFaults::steeplySlantedStep},
        {"light that texels hold already diffused counted as none", "passes/diffusion_light.frag",
         "constants.inTexels.rgb * light", "0.0 * light", &DiffusionFaults::coarseStep},
    };
    std::vector<std::pair<Measure, Measured>> sound; // each measured once, for all of its faults
    for (const Fault& fault : everyNth(faults, 3)) {
        SCOPED_TRACE(fault.what);
        const auto measure = [&](const ShaderMutant& shaders) { return (this->*fault.seenBy)(shaders.tree()); };
        auto known = std::ranges::find(sound, fault.seenBy, &std::pair<Measure, Measured>::first);
        if (known == sound.end()) known = sound.emplace(known, fault.seenBy, measure(ShaderMutant()));
        const ShaderMutant broken(fault.file, fault.from, fault.to);
        const Measured before = known->second, after = measure(broken);
        fmt::print("{:<55} {:.1e}, without it {:.1e}, at most {:.0e}\n", fault.what, after.found, before.found,
                   before.most);
        EXPECT_LE(before.found, before.most);
        EXPECT_GT(after.found, after.most);
    }
}

} // namespace
} // namespace tessera
