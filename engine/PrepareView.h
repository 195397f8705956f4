#pragma once
#include <string>

#include "engine/Settings.h"
#include "engine/Techniques.h"
#include "renderer/frame/PreparedView.h"

namespace tessera::engine {

/// Prepares a view. Throws InputError for a camera or light that the scene lacks, an invalid size or sample count, a
/// range tolerance that is negative or not finite, or a setting that the technique cannot draw. `bounds` are those of
/// the scene; only plans leave them out.
frame::PreparedView prepareView(const scenes::Scene& scene, Technique technique, const frame::FrameSettings& settings,
                                std::span<const frame::SurfaceBounds> bounds = {});

/// Throws InputError if views differ in a setting that all views of a frame share (Setting::isOfFrame), and
/// std::logic_error if there is no view.
void requireOneFrame(std::span<const ViewRequest> views);

/// Warning: lights whose shadow maps exceed the budget, with a remedy; empty if none.
std::string lostShadows(const frame::ShadowMaps& maps, const frame::FrameSettings& settings);
/// Warning: why the view shows fewer shadows than requested; empty if none are missing. `bounds` are of everything
/// drawn.
std::string missingShadows(const scenes::Scene& scene, std::span<const frame::SurfaceBounds> bounds,
                           const frame::PreparedView& prepared);
/// Warning: objects whose requested diffusion has no effect, since texels are larger than all widths of their profiles,
/// with a remedy; empty if none.
std::string invisibleDiffusion(const scenes::Scene& scene, const frame::PreparedView& prepared);
/// Warning: loops of shadows or of area light samples may exceed Mesa's iteration limit. `why` names cause and remedy;
/// it is empty within the limit.
struct CutShadows {
    std::string why;
    std::size_t iterations = 0;
};
CutShadows cutShadows(const frame::PreparedView& prepared);

/// The camera of the settings, at their eye offset.
scenes::Camera frameCamera(const scenes::Scene& scene, const frame::FrameSettings& settings);

} // namespace tessera::engine
