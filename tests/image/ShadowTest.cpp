#include "tests/image/ShadowTest.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/Load.h"
#include "scenes/LookAt.h"
#include "scenes/builtin/Shapes.h"
#include "tests/support/TestScenes.h"
#include "validation/compare/TechniqueCompare.h"

namespace tessera::test {

frame::FrameSettings settingsOf(const ShadowCase& tried) {
    frame::FrameSettings settings = exactOfSize(240, 135);
    settings.shadows = tried.shadows;
    return settings;
}

scenes::Scene sceneOf(const ShadowCase& tried) {
    scenes::LoadOptions options;
    options.lights = tried.lights;
    return scenes::loadScene(tried.scene, options);
}

std::vector<frame::ShadowFilter> mapFilters() {
    std::vector<frame::ShadowFilter> filters;
    for (const frame::ShadowFilterInfo& info : frame::shadowFilterTable())
        if (info.usesMaps) filters.push_back(info.filter);
    return filters;
}

scenes::Scene ballUnderSun() {
    scenes::Scene scene = scenes::loadScene("room");
    scenes::Mesh ball, floor;
    scenes::builtin::appendSphere(ball, glm::dvec3(0.0, 0.6, 0.0), 0.6, 64, 32);
    scenes::builtin::appendFloor(floor, glm::dvec3(0.0), glm::dvec2(4.0), glm::ivec2(4));
    scene.meshes = {ball, floor};
    scene.nodes.resize(1);
    scene.nodes[0] = {};
    scene.nodes[0].instances = {{0, 0}, {1, 0}};
    scene.cameras[0].worldFromCamera = scenes::worldFromLookAt({0.0, 2.2, 3.6}, {0.0, 0.4, 0.0});
    scene.lights = {sunLight({0.0, 0.0, -1.0}, 3.0f)};
    return scene;
}

glm::dvec3 sunDirection(int i, int count) {
    const double tilt = glm::radians(89.0) * (i + 0.5) / count, turn = 2.399963229728653 * i;
    return {std::sin(tilt) * std::cos(turn), -std::cos(tilt), std::sin(tilt) * std::sin(turn)};
}

void ShadowTest::expectParity(engine::Renderer& renderer, const frame::FrameSettings& settings,
                              std::vector<engine::Technique> techniques) {
    using engine::Technique;
    validation::CompareRequest request;
    const bool all = techniques.empty();
    request.techniques = std::move(techniques);
    for (const engine::TechniqueInfo& info : engine::techniqueTable())
        if (all && info.technique != Technique::Forward && (settings.samples == 1 || info.multisamples()))
            request.techniques.push_back(info.technique);
    request.settings = settings;
    const validation::CompareRecord record =
        validation::compareTechniques(renderer, context().capabilities(), request).record;
    EXPECT_TRUE(record.ok()) << validation::compareTable(record);
}

void ShadowTest::expectPruningIsUnseen(engine::Renderer& renderer, frame::FrameSettings settings,
                                       engine::Technique technique) {
    settings.prune = true;
    const std::vector<float> pruned = renderer.render(technique, settings).radiance;
    settings.prune = false;
    EXPECT_EQ(renderer.render(technique, settings).radiance, pruned);
}

ShadowReference shadowReference(const scenes::Scene& scene, const frame::FrameSettings& settings) {
    frame::FrameSettings unshadowed = settings;
    unshadowed.shadows = {scenes::ShadowRequest::Kind::None};
    return {validation::referencePicture(scene, settings), strictReference(scene, unshadowed)};
}

WrongPixels& WrongPixels::operator+=(const WrongPixels& other) {
    for (const auto member :
         {&WrongPixels::wrong, &WrongPixels::dark, &WrongPixels::leaks, &WrongPixels::leaksAtContacts,
          &WrongPixels::darkAtContacts, &WrongPixels::undecided, &WrongPixels::hidden, &WrongPixels::wrongWithout,
          &WrongPixels::reached, &WrongPixels::covered})
        this->*member += other.*member;
    return *this;
}

namespace {

/// Whether a neighbouring pixel shows another object at a similar depth. The limit is the depth change of a surface
/// seen at 80 degrees incidence over two pixels of an image with a 60 degree field of view.
bool isAtContact(const std::vector<reference::Ids>& ids, const std::vector<float>& depths, int width, int height,
                 std::size_t pixel) {
    const int x = int(pixel) % width, y = int(pixel) / width;
    for (int v = std::max(y - 2, 0); v <= std::min(y + 2, height - 1); ++v)
        for (int u = std::max(x - 2, 0); u <= std::min(x + 2, width - 1); ++u) {
            const auto other = std::size_t(v * width + u);
            if (ids[other].object == 0 || ids[other].object == ids[pixel].object) continue;
            const float apart = std::abs(depths[4 * other] - depths[4 * pixel]);
            if (apart < 12.0f / float(height) * depths[4 * pixel]) return true;
        }
    return false;
}

} // namespace

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
    const engine::RenderedFrame depths = [&] {
        frame::FrameSettings asDepth = settings;
        asDepth.view = frame::DebugView::Depth;
        return renderer.render(Technique::ClusteredDeferred, asDepth);
    }();
    const Picture nearest = truth.nearestTo(shown);
    WrongPixels count;
    std::vector<char> isHidden(shown.pixelCount(), 0), isDark(shown.pixelCount(), 0);
    for (std::size_t i = 0; i < shown.pixelCount(); ++i) {
        // Compares only pixels that show the reference's triangle: rounding moves edges.
        if (!truth.picture.covered[i] || ids.radiance[4 * i] != float(truth.ids[i].object) ||
            ids.radiance[4 * i + 1] != float(truth.ids[i].triangle))
            continue;
        ++count.covered;
        double largest = 0.0, darkest = 0.0, farthest = 0.0, changed = 0.0, wrongWithout = 0.0, largestLit = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double expected = double(nearest.rgba[4 * i + c]);
            largest = std::max(largest, std::abs(expected));
            // NaN counts as infinitely far.
            const double off = std::abs(double(shown.rgba[4 * i + c]) - expected);
            farthest = std::isnan(off) ? HUGE_VAL : std::max(farthest, off);
            darkest = std::max(darkest, expected - double(shown.rgba[4 * i + c]));
            largestLit = std::max(largestLit, double(lit.picture.rgba[4 * i + c]));
            wrongWithout = std::max(
                wrongWithout, std::abs(double(shownLit.radiance[4 * i + c]) - double(lit.picture.rgba[4 * i + c])));
            changed = std::max(changed,
                               std::abs(double(lit.picture.rgba[4 * i + c]) - double(truth.picture.rgba[4 * i + c])));
        }
        // Differs without shadows too: rounding chooses another texel.
        const bool isWrongWithout = wrongWithout > 0.01 * std::max(largestLit, 1e-4);
        count.wrongWithout += isWrongWithout;
        isDark[i] = !isWrongWithout && darkest > 0.01 * std::max(largest, 1e-4);
        const bool isWrong = !isWrongWithout && farthest > 0.01 * std::max(largest, 1e-4);
        const bool isContact = isWrong && isAtContact(truth.ids, depths.radiance, shown.width, shown.height, i);
        count.wrong += isWrong;
        count.leaks += isWrong && !isDark[i];
        count.leaksAtContacts += isContact && !isDark[i];
        count.darkAtContacts += isContact && isDark[i];
        count.reached += largestLit > 0.0;
        isHidden[i] = changed > 0.0 || !truth.alternatives[i].empty();
        count.undecided += !truth.alternatives[i].empty();
        count.hidden += changed > 0.01 * std::max(largest, 1e-4);
    }
    for (int y = 0; y < shown.height; ++y)
        for (int x = 0; x < shown.width; ++x) {
            if (!isDark[std::size_t(y * shown.width + x)]) continue;
            // The shadow may continue behind another object.
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

WrongPixels wrongUnderSuns(engine::Renderer& renderer, scenes::Scene& scene, const frame::FrameSettings& settings,
                           int directions) {
    WrongPixels sum;
    for (int i = 0; i < directions; ++i) {
        scene.lights[0].directionWS = sunDirection(i, directions);
        sum += wrongPixels(renderer, settings);
    }
    return sum;
}

} // namespace tessera::test
