#include "viewer/show/DiffusedLight.h"

#include <algorithm>

#include "renderer/frame/DebugViews.h"
#include "scenes/InUse.h"

namespace tessera::viewer {
namespace {

bool diffuses(const scenes::Scene& scene, const Look& look) {
    return frame::showsLitPicture(look.settings.view) && scenes::anyDiffuses(scene, look.settings.subsurface);
}

/// Whether a and b have the same diffused irradiance.
bool hasSameDiffusion(const Look& a, const Look& b) {
    Look like = a;
    like.aside = b.aside;
    for (const engine::Setting& setting : engine::settingTable())
        if (!setting.entersLight) setting.value.copy(like, b);
    return like == b;
}

/// Target time of a slice, which cannot be aborted: with the image that answers input, little more than 100 ms.
constexpr double kSliceMs = 80.0;
/// A slice's fixed cost, a frame with the whole mesh, is at most half of its time.
constexpr double kOfLeast = 2.0;
constexpr std::size_t kMostTiles = 65536;

} // namespace

std::optional<Look> sharedDiffusion(const scenes::Scene& scene, std::span<const Look> looks) {
    std::optional<Look> shared;
    for (const Look& look : looks) {
        if (!diffuses(scene, look)) continue;
        if (shared && !hasSameDiffusion(*shared, look)) return {};
        if (!shared) shared = look;
    }
    return shared;
}

void DiffusionPace::took(double ms) {
    leastMs_ = leastMs_ ? std::min(*leastMs_, ms) : ms;
    const double wantedMs = std::max(kSliceMs, kOfLeast * *leastMs_);
    // Tiles differ: one fast slice does not predict the others.
    const double factor = std::clamp(wantedMs / std::max(ms, 1e-3), 0.25, 2.0);
    tiles_ = std::clamp(std::size_t(double(tiles_) * factor), std::size_t(1), kMostTiles);
}

bool DiffusedLight::isAnew(const scenes::Scene& scene, std::span<const Look> looks, std::uint64_t edits) const {
    const Look* kept = kept_ && kept_->edits == edits ? &kept_->look : nullptr;
    for (const Look& look : looks) {
        if (!diffuses(scene, look)) continue;
        if (kept == nullptr || !hasSameDiffusion(*kept, look)) return true;
        kept = &look;
    }
    return false;
}

void DiffusedLight::drew(const scenes::Scene& scene, std::span<const Look> looks, std::uint64_t edits,
                         int mostIdlePictures) {
    for (const Look& look : looks) {
        if (diffuses(scene, look))
            kept_ = {look, edits};
        else if (kept_ && ++kept_->idlePictures > mostIdlePictures)
            forget();
    }
}

} // namespace tessera::viewer
