#pragma once

namespace tessera::app {

/// The commit of the build, with suffix "-dirty" if files had changed; "unknown" outside a repository.
extern const char* const kCommit;

} // namespace tessera::app
