#pragma once

namespace tessera::app {

/// Installs handlers for terminating signals (Ctrl-C, a closed terminal, kill) that first remove partially written
/// files. The program then ends by that signal, so that a shell sees the cause. While termination is deferred
/// (holdEnd()), the caller of holdEnd() does both.
void cleanUpWhenInterrupted();

/// Ends the program by SIGPIPE, like a program whose output pipe was closed. cleanUpWhenInterrupted() keeps
/// that signal from ending it elsewhere.
void endAsByClosedPipe();

} // namespace tessera::app
