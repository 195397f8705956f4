#pragma once
#include <optional>
#include <vector>

#include "tests/image/ImageTest.h"

/// What tests of shadows have in common, traced or in maps.
namespace tessera::test {

struct ShadowCase {
    const char* scene;
    std::optional<int> lights;
    scenes::ShadowRequest shadows;
    // Of the covered pixels of settingsOf(), as measured.
    double undecidedShare; ///< rounding decides whether some light is hidden, with exact terminators
    double softenedShare;  ///< the same with softened ones, of whose heights a pixel holds 8 bits
    double wrongShare;     ///< with `hard` and 1024 texels
};
inline constexpr ShadowCase kShadowCases[] = {
    {"lattice", 16, kAllLightsCast, 0.0039, 0.0011, 0.00015},
    {"head", {}, kAllLightsCast, 0.0136, 0.0045, 0.0040},
    {"hall", {}, {scenes::ShadowRequest::Kind::Asked}, 0.0028, 0.0015, 0.0036}};

scenes::Scene sceneOf(const ShadowCase& tried);
/// As its wrong pixels are counted: 240x135, with textures that the reference has to the last digits.
frame::FrameSettings settingsOf(const ShadowCase& tried);

/// The filters that look maps up.
std::vector<frame::ShadowFilter> mapFilters();

/// A ball on a floor under one sun.
scenes::Scene ballUnderSun();
/// Where the light of sun i of so many travels: even in the angle from straight above, to 89 degrees, a golden angle
/// apart.
glm::dvec3 sunDirection(int i, int count);

class ShadowTest : public ImageTest {
protected:
    /// Expects that all techniques draw what forward does.
    void expectParity(engine::Renderer& renderer, const frame::FrameSettings& settings,
                      std::vector<engine::Technique> techniques = {});
    /// Expects that a technique draws the same bits pruned and not.
    void expectPruningIsUnseen(engine::Renderer& renderer, frame::FrameSettings settings,
                               engine::Technique technique = engine::Technique::Deferred);
};

/// Of a picture against the reference: those that are lit where they should be hidden or the reverse.
struct WrongPixels {
    std::size_t wrong = 0; ///< farther from the definition than a hundredth, whatever rounding allows
    std::size_t dark = 0;  ///< those among them that are too dark, while the pixels beside them are of the same object
                           ///< and no shadow changes them
    std::size_t leaks = 0; ///< those among them that are too light
    std::size_t leaksAtContacts = 0, darkAtContacts = 0; ///< those too light and too dark where two objects meet
    std::size_t undecided = 0;                           ///< rounding decides whether some light is hidden
    std::size_t hidden = 0;                              ///< shadows change them
    std::size_t wrongWithout = 0; ///< differ without shadows already, and are not counted as wrong
    std::size_t reached = 0;      ///< some light would give them something if nothing hid it
    std::size_t covered = 0;
    WrongPixels& operator+=(const WrongPixels& other);
    std::string text() const {
        return fmt::format("{} pixels wrong, {} undecided, {} dark beside no shadow, {} changed by shadows of {}",
                           wrong, undecided, dark, hidden, covered);
    }
};

/// What pictures with shadows are compared with.
struct ShadowReference {
    validation::ReferencePicture shadowed, lit;
};
ShadowReference shadowReference(const scenes::Scene& scene, const frame::FrameSettings& settings);

WrongPixels wrongPixels(engine::Renderer& renderer, const frame::FrameSettings& settings, const ShadowReference& truth);
inline WrongPixels wrongPixels(engine::Renderer& renderer, const frame::FrameSettings& settings) {
    return wrongPixels(renderer, settings, shadowReference(renderer.scene(), settings));
}

/// Sums them over so many directions of the first light of the renderer's scene, which is `scene`.
WrongPixels wrongUnderSuns(engine::Renderer& renderer, scenes::Scene& scene, const frame::FrameSettings& settings,
                           int directions);

} // namespace tessera::test
