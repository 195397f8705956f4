#pragma once

namespace tessera::app {

/// From now on a signal that ends the program (Ctrl-C, a closed terminal, kill) first removes the files that are not
/// written whole. The program then ends by that signal, so that a shell sees why. Where the end is held (holdEnd()),
/// who holds it does that.
void cleanUpWhenInterrupted();

/// Ends the program by SIGPIPE, like a program whose output pipe was closed. cleanUpWhenInterrupted() keeps
/// that signal from ending it elsewhere.
void endAsByClosedPipe();

} // namespace tessera::app
