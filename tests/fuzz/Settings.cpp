#include <cstdlib>

#include "tests/fuzz/Readers.h"
#include "viewer/session/Preferences.h"

namespace tessera::fuzz {

/// What the viewer remembers. It remembers the same when it is written and read again.
void readSettings(const std::filesystem::path& file) {
    const viewer::Preferences preferences = viewer::readPreferences(file);
    const std::filesystem::path again = file.parent_path() / "again" / "viewer.json";
    viewer::writePreferences(preferences, again);
    if (!(viewer::readPreferences(again) == preferences)) std::abort();
}

} // namespace tessera::fuzz
