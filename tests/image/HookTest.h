#pragma once
#include <cstddef>
#include <span>

#include "scenes/Fingerprint.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/TempFolder.h"

namespace tessera::test {

inline constexpr std::string_view kSurfaceHeader = "void hookSurface(inout HookedSurface surface, HookInputs inputs)\n";
inline constexpr std::string_view kVertexHeader =
    "void hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv)\n";

/// Renders scenes with hooks written by the test.
class HookTest : public ShadowTest {
protected:
    /// Adds a hook of all materials to the scene, with this body of hookSurface and a parameter `strength`.
    scenes::Scene hooked(scenes::Scene scene, std::string_view body, float strength = 0.7f) {
        scenes::Hook& hook = scene.hook.emplace();
        setText(hook, std::string(kSurfaceHeader).append(body));
        for (std::size_t i = 0; i < scene.materials.size(); ++i) hook.materials.push_back(int(i));
        hook.parameters = {{"strength", strength, 0.0f, 1.0f}};
        scenes::checkScene(scene);
        return scene;
    }
    static frame::FrameSettings smallSettings() {
        frame::FrameSettings settings = withDiffusion(ofSize(160, 91));
        return settings;
    }
    std::vector<float> drawn(const scenes::Scene& scene, const frame::FrameSettings& settings,
                             engine::Technique technique = engine::Technique::Forward) {
        return ShadowTest::drawn(scene, settings, technique);
    }

    /// Writes the text to a new file and sets it as the hook's source.
    void setText(scenes::Hook& hook, const std::string& text) {
        hook.file = folder.write(fmt::format("{}.glsl", files_++), text).string();
        hook.contentHash = scenes::fingerprint(std::as_bytes(std::span(text)));
    }

    TempFolder folder;

private:
    int files_ = 0;
};

} // namespace tessera::test
