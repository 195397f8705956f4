#pragma once

/// Deferred termination by signals, where an immediate end would lose work.
namespace tessera {

/// Starts or stops deferring termination. While deferred, signals are recorded; the caller must poll notedEnd() often.
void holdEnd(bool isHeld) noexcept;

/// Records a signal if termination is deferred, else returns false. Async-signal-safe.
bool noteEnd(int signal) noexcept;

/// The recorded signal; 0: none.
int notedEnd() noexcept;

/// Removes partially written files and ends the program by the recorded signal, so that a shell sees the cause. Call
/// only after the signal's default action is restored.
void endAsNoted();

} // namespace tessera
