#include "tests/image/ShadowTest.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "validation/compare/TechniqueCompare.h"

namespace tessera::test {

void ShadowTest::expectParity(engine::Renderer& renderer, const frame::FrameSettings& settings) {
    using engine::Technique;
    validation::CompareRequest request;
    for (const engine::TechniqueInfo& info : engine::techniqueTable())
        if (info.technique != Technique::Forward && (settings.samples == 1 || info.multisamples()))
            request.techniques.push_back(info.technique);
    request.settings = settings;
    const validation::CompareRecord record =
        validation::compareTechniques(renderer, context().capabilities(), request).record;
    EXPECT_TRUE(record.ok()) << validation::compareTable(record);
}

ShadowReference shadowReference(const scenes::Scene& scene, const frame::FrameSettings& settings) {
    frame::FrameSettings unshadowed = settings;
    unshadowed.shadows = {scenes::ShadowRequest::Kind::None};
    return {validation::referencePicture(scene, settings), validation::referencePicture(
                                                               scene, unshadowed, [] {}, false)};
}

WrongPixels wrongPixels(engine::Renderer& renderer, const frame::FrameSettings& settings,
                        const ShadowReference& truths) {
    using engine::Technique;
    const validation::ReferencePicture &truth = truths.shadowed, &lit = truths.lit;
    const engine::RenderedFrame frame = renderer.render(Technique::ClusteredDeferred, settings);
    const Picture shown{frame.width, frame.height, frame.radiance, {}};
    frame::FrameSettings unshadowed = settings;
    unshadowed.shadows = {scenes::ShadowRequest::Kind::None};
    const engine::RenderedFrame shownLit = renderer.render(Technique::ClusteredDeferred, unshadowed);
    const engine::RenderedFrame ids = [&] {
        frame::FrameSettings asIds = settings;
        asIds.view = frame::DebugView::Ids;
        return renderer.render(Technique::ClusteredDeferred, asIds);
    }();
    const Picture nearest = truth.nearestTo(shown);
    WrongPixels count;
    std::vector<char> isHidden(shown.pixelCount(), 0), isDark(shown.pixelCount(), 0);
    for (std::size_t i = 0; i < shown.pixelCount(); ++i) {
        // The same triangle, or an edge that rounding moves.
        if (!truth.picture.covered[i] || ids.radiance[4 * i] != float(truth.ids[i].object) ||
            ids.radiance[4 * i + 1] != float(truth.ids[i].triangle))
            continue;
        ++count.covered;
        double largest = 0.0, darkest = 0.0, farthest = 0.0, changed = 0.0, wrongWithout = 0.0, largestLit = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double expected = double(nearest.rgba[4 * i + c]);
            largest = std::max(largest, std::abs(expected));
            farthest = std::max(farthest, std::abs(double(shown.rgba[4 * i + c]) - expected));
            darkest = std::max(darkest, expected - double(shown.rgba[4 * i + c]));
            largestLit = std::max(largestLit, double(lit.picture.rgba[4 * i + c]));
            wrongWithout = std::max(
                wrongWithout, std::abs(double(shownLit.radiance[4 * i + c]) - double(lit.picture.rgba[4 * i + c])));
            changed = std::max(changed,
                               std::abs(double(lit.picture.rgba[4 * i + c]) - double(truth.picture.rgba[4 * i + c])));
        }
        // Not by shadows, but where rounding chooses another texel.
        const bool isWrongWithout = wrongWithout > 0.01 * std::max(largestLit, 1e-4);
        count.wrongWithout += isWrongWithout;
        count.wrong += !isWrongWithout && farthest > 0.01 * std::max(largest, 1e-4);
        isDark[i] = !isWrongWithout && darkest > 0.01 * std::max(largest, 1e-4);
        isHidden[i] = changed > 0.0 || !truth.alternatives[i].empty();
        count.undecided += !truth.alternatives[i].empty();
        count.hidden += changed > 0.01 * std::max(largest, 1e-4);
    }
    for (int y = 0; y < shown.height; ++y)
        for (int x = 0; x < shown.width; ++x) {
            if (!isDark[std::size_t(y * shown.width + x)]) continue;
            // Behind another object the shadow may go on.
            const std::size_t own = std::size_t(y * shown.width + x);
            bool isBesideShadow = false;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, shown.height - 1); ++v)
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, shown.width - 1); ++u) {
                    const std::size_t other = std::size_t(v * shown.width + u);
                    isBesideShadow =
                        isBesideShadow || isHidden[other] || truth.ids[other].object != truth.ids[own].object;
                }
            count.dark += !isBesideShadow;
        }
    return count;
}

} // namespace tessera::test
