#include "tests/cli/program/Cli.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/PictureFile.h"
#include "tests/support/Sweep.h"
#include "tests/support/UnderLedger.h"
#include "validation/pictures/ReadPicture.h"

namespace tessera::test {

namespace fs = std::filesystem;

ProcessResult Cli::run(const Words& arguments, const Environment& environment) const {
    Words command{kProgram};
    command.insert(command.end(), arguments.begin(), arguments.end());
    ProcessResult result = runProcess(command, {folder_.path(), environment, 60.0});
    // Any test may be the first to filter a map, so the note is removed, except where a test has a separate cache.
    if (const std::size_t note = result.err.find(kFilteringNote);
        note != std::string::npos && !environment.contains("XDG_CACHE_HOME"))
        result.err.erase(note, kFilteringNote.size());
    return result;
}

std::string Cli::runGood(const Words& arguments, const Environment& environment) const {
    SCOPED_TRACE(fmt::format("tessera {}", fmt::join(arguments, " ")));
    const ProcessResult result = run(arguments, environment);
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    return result.out;
}

int Cli::killedUntilItEnds(const Words& arguments) const {
    Words command{kProgram};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const int stepMilliseconds = isWholeSweep() ? 131 : 431; // primes, which no period divides
    int kills = 0;
    for (int attempt = 0; attempt < 40; ++attempt) {
        Process process(command, {folder_.path(), {}, 60.0});
        std::thread killer([&process, attempt, stepMilliseconds] {
            // Starts before the first image.
            std::this_thread::sleep_for(std::chrono::milliseconds(200 + stepMilliseconds * attempt));
            try {
                process.send(SIGKILL);
            } catch (const std::runtime_error&) { // it has ended
            }
        });
        const ProcessResult result = process.wait();
        killer.join();
        EXPECT_EQ(result.exitCode.value_or(0), 0) << result.err;
        if (result.exitCode) return kills;
        ++kills;
    }
    ADD_FAILURE() << "it never ends";
    return kills;
}

void Cli::expectError(int exitCode, const Words& arguments, const Words& parts, const Environment& environment) const {
    SCOPED_TRACE(fmt::format("tessera {}", fmt::join(arguments, " ")));
    const std::map<std::string, std::string> before = files();
    const ProcessResult result = run(arguments, environment);
    EXPECT_EQ(result.exitCode, exitCode);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, testing::StartsWith("tessera: error: "));
    EXPECT_THAT(result.err, testing::EndsWith("\n"));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    for (const std::string& part : parts) EXPECT_THAT(result.err, testing::HasSubstr(part));
    EXPECT_TRUE(files() == before) << "a file was made, changed or removed";
}

std::string Cli::text(const std::string& name) const {
    std::ifstream stream(path(name), std::ios::binary);
    EXPECT_TRUE(stream.good()) << "there is no " << name;
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

Picture Cli::picture(const std::string& name) const {
    return underLedger(validation::readPicture, path(name));
}

std::map<std::string, std::string> Cli::files() const {
    std::map<std::string, std::string> contents;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_.path())) {
        const std::string name = fs::relative(entry.path(), folder_.path()).string();
        contents[name] = entry.is_regular_file() ? text(name) : "";
    }
    return contents;
}

void Cli::writeQuad(const std::string& material, const std::string& lights) const {
    folder_.write("quad.obj", "v -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
                              "f 1/1/1 2/2/1 3/3/1 4/4/1\n");
    folder_.write(
        "quad.json",
        fmt::format(
            R"({{"tessera": 1, "include": [{{"file": "quad.obj", "name": "square", "transform": {{"eulerDegrees": [0, 15, 0]}}}}],
        "materials": [{}], "overrides": [{{"node": "square", "material": "paint"}}], "lights": {},
        "cameras": [{{"name": "front", "position": [0, 0, 2], "target": [0, 0, 0], "fovYDegrees": 60}}]}})",
            material, lights));
}

ProcessResult runShell(const std::string& script, const fs::path& folder) {
    return runProcess({"sh", "-c", script}, {folder, {}, 60.0});
}

} // namespace tessera::test
