// The hooks of scenes/files.
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scenes/Load.h"
#include "tests/image/HookTest.h"
#include "tests/support/Sweep.h"

namespace tessera {
namespace {

using engine::Technique;

constexpr const char* kHookSamples[] = {"flag", "pulsating_lattice", "head_sick"};

/// At the ends of their parameters.
class SampleHooks : public test::HookTest {
protected:
    static scenes::Scene sample(std::string_view name) {
        return scenes::loadScene(fmt::format("{}/scenes/files/{}.json", TESSERA_SOURCE_DIR, name));
    }
    /// At twelve times, or at each third of them.
    void expectWithinMayMoveMetres();
};
using SampleHooksSlow = SampleHooks;

void SampleHooks::expectWithinMayMoveMetres() {
    for (const char* name : kHookSamples) {
        SCOPED_TRACE(name);
        scenes::Scene scene = sample(name);
        engine::Renderer renderer(context(), scene);
        for (const bool most : {false, true}) {
            for (scenes::HookParameter& parameter : scene.hook->parameters)
                parameter.value = most ? parameter.most : parameter.least;
            for (int step = 0; step < 12; step += test::isWholeSweep() ? 1 : 3)
                EXPECT_NO_THROW(renderer.sceneAt(0.37 * step));
        }
    }
}

TEST_F(SampleHooks, verticesStayWithinMayMoveMetres) {
    expectWithinMayMoveMetres();
}
TEST_F(SampleHooksSlow, verticesStayWithinMayMoveMetres) {
    expectWithinMayMoveMetres();
}

/// Whatever sines become of a billion.
TEST_F(SampleHooks, verticesStayWithinMayMoveMetresAfterABillionSeconds) {
    for (const char* name : kHookSamples) {
        SCOPED_TRACE(name);
        const scenes::Scene scene = sample(name);
        engine::Renderer renderer(context(), scene);
        for (const double seconds : {1e9, -1e9}) EXPECT_NO_THROW(renderer.sceneAt(seconds));
    }
}

TEST_F(SampleHooks, everyParameterChangesThePicture) {
    for (const char* name : kHookSamples) {
        scenes::Scene scene = sample(name);
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = smallSettings();
        settings.timeSeconds = 2.9;
        settings.subsurface = scenes::SubsurfaceMethod::None;
        const std::vector<float> before = renderer.render(Technique::Forward, settings).radiance;
        for (scenes::HookParameter& parameter : scene.hook->parameters) {
            const float value = std::exchange(parameter.value, parameter.most);
            EXPECT_NE(renderer.render(Technique::Forward, settings).radiance, before) << name << ' ' << parameter.name;
            parameter.value = value;
        }
        EXPECT_EQ(renderer.render(Technique::Forward, settings).radiance, before) << name;
    }
}

} // namespace
} // namespace tessera
