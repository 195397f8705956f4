#pragma once

namespace tessera::viewer {

/// Sizes and colours of the panels, for a display of `scale` times the standard density: dark greys, so that the image
/// is the brightest element, and one accent.
void applyTheme(float scale);

} // namespace tessera::viewer
