#pragma once
#include "viewer/edit/LightFigure.h"

namespace tessera::viewer {

/// Adds a light's handles to its figure, each if the image has room for it: clear of the light's marker and of earlier
/// handles.
class HandlePlacer {
public:
    /// As for lightFigure(). The figure's middle, and a directional light's sun, must be set before add().
    HandlePlacer(const scenes::Light& light, const PictureView& view, double scale, LightFigure& figure)
        : light_(light), view_(view), scale_(scale), figure_(figure) {}

    /// Adds a handle if it is visible, and dragging it has an effect.
    void add(LightHandle handle);

private:
    bool isInPicture(const glm::dvec2& place) const;
    /// Keeps a handle at least this far from the light's marker, which would be grabbed instead, and moves it outwards
    /// clear of earlier handles. A sun needs neither. Returns whether the image has such a position.
    bool standOff(LightHandle& handle, double least) const;

    const scenes::Light& light_;
    const PictureView& view_;
    double scale_;
    LightFigure& figure_;
    int count_ = 0; ///< of handles so far
};

} // namespace tessera::viewer
