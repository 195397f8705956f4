#include <cstdlib>

#include "tests/fuzz/Readers.h"
#include "viewer/session/Preferences.h"

namespace tessera::fuzz {

/// The viewer's preferences. Written and read again, they must be equal.
void readSettings(const std::filesystem::path& file) {
    const viewer::Preferences preferences = viewer::readPreferences(file);
    const std::filesystem::path again = file.parent_path() / "again" / "viewer.json";
    viewer::writePreferences(preferences, again);
    if (!(viewer::readPreferences(again) == preferences)) std::abort();
}

} // namespace tessera::fuzz
