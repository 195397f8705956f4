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

/// Runs the program in a folder of the test's own.
class Cli : public testing::Test {
protected:
    using Environment = std::map<std::string, std::string>;
    /// Neither a driver for EGL nor a display.
    static inline const Environment kNoGraphics{
        {"__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent"}, {"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}};

    /// What is said on stderr before a map is filtered.
    static inline const std::string kFilteringNote =
        "tessera: note: filtering the environment, once for each map: that takes seconds\n";

    /// Without kFilteringNote, unless the environment has an XDG_CACHE_HOME.
    ProcessResult run(const Words& arguments, const Environment& environment = {}) const;
    /// Expects exit code 0 and a silent stderr; returns stdout.
    std::string runGood(const Words& arguments, const Environment& environment = {}) const;
    /// Runs the program, kills it somewhere and runs it again, until it ends by itself; after times that grow by a
    /// step, which is longer outside of a whole sweep (Sweep.h). Returns how often it was killed.
    int killedUntilItEnds(const Words& arguments) const;
    /// Expects the exit code, nothing on stdout, exactly one line on stderr that begins with "tessera: error: " and
    /// holds all of `parts`, and every file of the folder as it was.
    void expectError(int exitCode, const Words& arguments, const Words& parts,
                     const Environment& environment = {}) const;

    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    std::string text(const std::string& name) const;
    nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(text(name)); }
    Picture picture(const std::string& name) const;
    std::map<std::string, std::string> files() const; ///< contents by name, folders and devices without

    /// "quad.json": a square that fills the picture, turned a little from the camera, in the material given as JSON
    /// ("name": "paint"), with the JSON list of lights.
    void writeQuad(const std::string& material, const std::string& lights) const;

    TempFolder folder_;
};

/// Programs of another kind, in the same folder: the shell.
ProcessResult runShell(const std::string& script, const std::filesystem::path& folder);

inline constexpr const char* kProgram = TESSERA_PROGRAM;

} // namespace tessera::test
