#pragma once

/// Signals that ask for the program's end, where work would be lost if it ended at once.
namespace tessera {

/// Whether the end waits: such a signal is then noted, and who holds the end looks for it (notedEnd()) often.
void holdEnd(bool isHeld) noexcept;

/// Notes a signal where the end is held; false, and nothing is noted, where it is not. Async-signal-safe.
bool noteEnd(int signal) noexcept;

/// The signal that was noted; 0: none.
int notedEnd() noexcept;

/// Ends the program by the signal that was noted, so that a shell sees why, without files that are not written whole.
/// To be called once the handler of that signal is the system's own again.
void endAsNoted();

} // namespace tessera
