#pragma once

namespace tessera::app {

/// The commit that the program was built from, "-dirty" behind it where files had changed; "unknown" outside a
/// repository.
extern const char* const kCommit;

} // namespace tessera::app
