#pragma once
#include <optional>
#include <vector>

#include "tests/image/ImageTest.h"

/// Shared scenes and fixtures of tests of traced and mapped shadows.
namespace tessera::test {

struct ShadowCase {
    const char* scene;
    std::optional<int> lights;
    scenes::ShadowRequest shadows;
    // Measured fractions of the covered pixels of settingsOf().
    double undecidedShare; ///< the visibility of some light depends on rounding, with exact terminators
    double softenedShare;  ///< the same with softened terminators, whose heights have 8 bits per pixel
    double wrongShare;     ///< wrong with filter `hard` and 1024 texels
};
inline constexpr ShadowCase kShadowCases[] = {
    {"lattice", 16, kAllLightsCast, 0.0039, 0.0011, 0.00015},
    {"head", {}, kAllLightsCast, 0.0136, 0.0045, 0.0040},
    {"hall", {}, {scenes::ShadowRequest::Kind::Scene}, 0.0028, 0.0015, 0.0036}};

scenes::Scene sceneOf(const ShadowCase& tried);
/// Settings for counting wrong pixels: 240x135, with texture values exactly as in the reference.
frame::FrameSettings settingsOf(const ShadowCase& tried);

/// The filters that read shadow maps.
std::vector<frame::ShadowFilter> mapFilters();

/// A ball on a floor under one sun.
scenes::Scene ballUnderSun();
/// Direction of travel of the light of sun i of `count`: angles from vertical evenly spaced up to 89 degrees, azimuths
/// a golden angle apart.
glm::dvec3 sunDirection(int i, int count);

class ShadowTest : public ImageTest {
protected:
    /// Expects all techniques to render the same image as forward.
    void expectParity(engine::Renderer& renderer, const frame::FrameSettings& settings,
                      std::vector<engine::Technique> techniques = {});
    /// Expects identical bits with and without pruning.
    void expectPruningIsUnseen(engine::Renderer& renderer, frame::FrameSettings settings,
                               engine::Technique technique = engine::Technique::Deferred);
};

/// Counts of shadow errors of an image against the reference.
struct WrongPixels {
    std::size_t wrong = 0; ///< off by more than a hundredth from every value that rounding allows
    std::size_t dark = 0;  ///< wrong and too dark, with neither a shadow nor another object in the 3x3 pixels
    std::size_t leaks = 0; ///< wrong and too bright
    std::size_t leaksAtContacts = 0, darkAtContacts = 0; ///< too bright or too dark where two objects meet
    std::size_t undecided = 0;                           ///< the visibility of some light depends on rounding
    std::size_t hidden = 0;                              ///< changed by shadows
    std::size_t wrongWithout = 0;                        ///< differ already without shadows; not counted as wrong
    std::size_t reached = 0;                             ///< lit by some light without shadows
    std::size_t covered = 0;
    WrongPixels& operator+=(const WrongPixels& other);
    std::string text() const {
        return fmt::format("{} pixels wrong, {} undecided, {} dark beside no shadow, {} changed by shadows of {}",
                           wrong, undecided, dark, hidden, covered);
    }
};

/// Reference images with and without shadows.
struct ShadowReference {
    validation::ReferencePicture shadowed, lit;
};
ShadowReference shadowReference(const scenes::Scene& scene, const frame::FrameSettings& settings);

WrongPixels wrongPixels(engine::Renderer& renderer, const frame::FrameSettings& settings, const ShadowReference& truth);
inline WrongPixels wrongPixels(engine::Renderer& renderer, const frame::FrameSettings& settings) {
    return wrongPixels(renderer, settings, shadowReference(renderer.scene(), settings));
}

/// Sums wrongPixels() over `directions` directions of the first light of `scene`, which is the renderer's scene.
WrongPixels wrongUnderSuns(engine::Renderer& renderer, scenes::Scene& scene, const frame::FrameSettings& settings,
                           int directions);

} // namespace tessera::test
