#pragma once
#include "viewer/session/ViewerOptions.h"

/// The interactive viewer: a window that opens scenes, renders them with every technique, and edits them.
namespace tessera::viewer {

/// Opens the window and returns when it is closed. Throws std::runtime_error without a display or OpenGL 4.5; later
/// errors are shown in the window.
void runViewer(const ViewerOptions& options);

} // namespace tessera::viewer
