#pragma once

namespace tessera::viewer {

/// Sizes and colours of the panels, for a display `scale` times as dense as usual: dark greys that leave the picture
/// the only thing that shines, and one accent.
void applyTheme(float scale);

} // namespace tessera::viewer
