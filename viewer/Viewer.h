#pragma once
#include "viewer/session/ViewerOptions.h"

/// The interactive viewer: a window in which scenes are opened, looked at by every technique, and edited.
namespace tessera::viewer {

/// Opens the window and returns when it is closed. Throws std::runtime_error where there is no display or no OpenGL
/// 4.5; later errors are shown in the window.
void runViewer(const ViewerOptions& options);

} // namespace tessera::viewer
