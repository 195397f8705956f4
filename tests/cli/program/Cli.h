#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/Picture.h"
#include "tests/support/Process.h"
#include "tests/support/TempFolder.h"

namespace tessera::test {

using Words = std::vector<std::string>;

/// Exit codes of the program.
inline constexpr int kGood = 0, kBadInput = 2, kToleranceMissed = 3;

/// Runs the program in a temporary folder.
class Cli : public testing::Test {
protected:
    using Environment = std::map<std::string, std::string>;
    /// An environment without an EGL driver and without a display.
    static inline const Environment kNoGraphics{
        {"__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent"}, {"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}};

    /// Printed on stderr before a map is filtered.
    static inline const std::string kFilteringNote =
        "tessera: note: filtering the environment, once for each map: that takes seconds\n";

    /// Runs the program. Removes kFilteringNote from stderr, unless `environment` sets XDG_CACHE_HOME.
    ProcessResult run(const Words& arguments, const Environment& environment = {}) const;
    /// Expects exit code 0 and an empty stderr; returns stdout.
    std::string runGood(const Words& arguments, const Environment& environment = {}) const;
    /// Runs the program, kills it after a delay and runs it again, until it ends by itself. The delay grows by a step,
    /// which is longer outside of a whole sweep (Sweep.h). Returns the number of kills.
    int killedUntilItEnds(const Words& arguments) const;
    /// Expects the exit code, nothing on stdout, exactly one line on stderr that begins with "tessera: error: " and
    /// contains all of `parts`, and unchanged files in the folder.
    void expectError(int exitCode, const Words& arguments, const Words& parts,
                     const Environment& environment = {}) const;

    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    std::string text(const std::string& name) const;
    nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(text(name)); }
    Picture picture(const std::string& name) const;
    std::map<std::string, std::string> files() const; ///< contents by name; empty for folders and devices

    /// Writes "quad.json": a square that fills the image, turned a little from the camera, with the material given as
    /// JSON ("name": "paint") and the JSON list of lights.
    void writeQuad(const std::string& material, const std::string& lights) const;

    TempFolder folder_;
};

/// Runs a shell script in the folder.
ProcessResult runShell(const std::string& script, const std::filesystem::path& folder);

inline constexpr const char* kProgram = TESSERA_PROGRAM;

} // namespace tessera::test
