#pragma once
#include "viewer/edit/LightFigure.h"

namespace tessera::viewer {

/// Adds handles to the figure of a light, each where the picture has a place for it: clear of the light's marker and of
/// the handles before it.
class HandlePlacer {
public:
    /// As lightFigure() has them. The figure has its middle, and the sun of a directional light, when handles come.
    HandlePlacer(const scenes::Light& light, const PictureView& view, double scale, LightFigure& figure)
        : light_(light), view_(view), scale_(scale), figure_(figure) {}

    /// If the picture shows it, and a drag would change something.
    void add(LightHandle handle);

private:
    bool isInPicture(const glm::dvec2& place) const;
    /// Keeps a handle so far from the light's marker, which would be taken in its place, and outwards clear of the
    /// handles before it. A sun has neither. Returns whether the picture has such a place.
    bool standOff(LightHandle& handle, double least) const;

    const scenes::Light& light_;
    const PictureView& view_;
    double scale_;
    LightFigure& figure_;
    int count_ = 0; ///< of handles
};

} // namespace tessera::viewer
