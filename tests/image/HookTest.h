#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "engine/Rendering.h"
#include "scenes/Fingerprint.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/TempFolder.h"
#include "tests/support/TestScenes.h"

namespace tessera::test {

inline constexpr std::string_view kSurfaceHeader = "void hookSurface(inout HookedSurface surface, HookInputs inputs)\n";
inline constexpr std::string_view kVertexHeader =
    "void hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv)\n";

/// Draws scenes with hooks that a test writes.
class HookTest : public ShadowTest {
protected:
    /// The scene with a hook of all its materials, which has a parameter `strength` and this body of hookSurface.
    scenes::Scene hooked(scenes::Scene scene, std::string_view body, float strength = 0.7f) {
        scenes::Hook& hook = scene.hook.emplace();
        setText(hook, std::string(kSurfaceHeader).append(body));
        for (std::size_t i = 0; i < scene.materials.size(); ++i) hook.materials.push_back(int(i));
        hook.parameters = {{"strength", strength, 0.0f, 1.0f}};
        scenes::checkScene(scene);
        return scene;
    }
    static frame::FrameSettings smallSettings() {
        frame::FrameSettings settings;
        settings.sizePixels = {160, 91};
        settings.diffusion = coarseDiffusion();
        return settings;
    }
    std::vector<float> drawn(const scenes::Scene& scene, const frame::FrameSettings& settings,
                             engine::Technique technique = engine::Technique::Forward) {
        return engine::Renderer(context(), scene).render(technique, settings).radiance;
    }

    /// Writes the text to a file of its own, and makes that the hook's.
    void setText(scenes::Hook& hook, const std::string& text) {
        hook.file = folder.write(fmt::format("{}.glsl", files_++), text).string();
        hook.contentHash = scenes::fingerprint(std::as_bytes(std::span(text)));
    }

    TempFolder folder;

private:
    int files_ = 0;
};

} // namespace tessera::test
