#include <csignal>
#include <filesystem>
#include <thread>

#include "tests/cli/program/Cli.h"
#include "tests/support/Sweep.h"

namespace tessera::test {
namespace {

namespace fs = std::filesystem;

constexpr int kFailed = 1;

class Output : public Cli {
protected:
    static bool isTemporary(const std::string& name) { return fs::path(name).extension() == ".tmp"; }

    void expectNoTemporaries() const {
        for (const auto& [name, contents] : files()) EXPECT_FALSE(isTemporary(name)) << name;
    }
    /// At twelve points of its loop in a whole sweep, else at four.
    void expectInterruptionsLeaveNoTemporaries();
};
using OutputSlow = Output;

TEST_F(Output, placesWhereNothingCanBeWrittenAreNamedAndNeverTouched) {
    fs::create_directory(folder_.path() / "folder.png");
    folder_.write("file", "no folder");
    expectError(kFailed, {"render", "room", "-o", "nix/a.png"}, {"nix/a.png", "there is no folder nix"});
    expectError(kFailed, {"render", "room", "-o", "folder.png"}, {"folder.png", "folder"});
    expectError(kFailed, {"render", "room", "-o", "file/a.png"}, {"file/a.png"});
    expectError(kFailed, {"render", "room", "-o", "/proc/a.png"}, {"/proc/a.png"});
    expectError(kFailed, {"render", "room", "--frames", "2", "-o", "nix/%d.png"}, {"nix/0.png"});
    expectError(kFailed, {"render", "room", "-o", std::string(300, 'a') + ".png"}, {"too long"});
    expectError(kFailed, {"plan", "room", "--json", "nix/p.json", "--dot", "p.dot"}, {"nix/p.json"});
    expectError(kFailed, {"plan", "room", "--json", "p.json", "--dot", "nix/p.dot"}, {"nix/p.dot"});
    expectError(kFailed, {"compare", "room", "--json", "nix/c.json"}, {"nix/c.json"});
    expectError(kFailed, {"compare", "room", "--json", "c.json", "--heatmap", "file"}, {"file", "not a folder"});
    expectError(kFailed, {"compare", "room", "--heatmap", "/proc/nix"}, {"/proc/nix"});
    expectError(kFailed, {"demo", "room", "-o", "file/report"}, {"file/report", "not a folder"});
}

TEST_F(Output, aFullDiskIsAnErrorThatKeepsTheOlderPicture) {
    fs::create_symlink("/dev/full", folder_.path() / "full.exr");
    expectError(kFailed, {"render", "room", "--camera", "corner", "--size", "16x9", "-o", "full.exr"},
                {"full.exr", "No space left", "free some space"});
    expectError(kFailed, {"plan", "room", "--json", "/dev/full"}, {"/dev/full", "No space left"});

    folder_.write("old.exr", "an older picture");
    const std::map<std::string, std::string> before = files();
    // Limits files written from here on to 1 block: 512 or 1024 bytes, depending on the shell.
    const ProcessResult limited =
        runShell(std::string("ulimit -f 1; exec ") + kProgram + " render lattice --lights 8 --size 160x90 -o old.exr",
                 folder_.path());
    EXPECT_EQ(limited.exitCode, kFailed);
    EXPECT_THAT(limited.err, testing::HasSubstr("tessera: error: cannot write old.exr: File too large"));
    EXPECT_TRUE(files() == before);
}

TEST_F(Output, failedPrintingIsAnError) {
    const ProcessResult result = runShell(std::string(kProgram) + " --help > /dev/full", folder_.path());
    EXPECT_EQ(result.exitCode, kFailed);
    EXPECT_THAT(result.err, testing::HasSubstr("tessera: error: cannot write the output: No space left on device"));
}

TEST_F(Output, aReaderWhoLeftCostsNoFile) {
    folder_.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ncurv 1 2\nf 1 2 3\n"); // warns of the curve
    const std::string tessera = kProgram;
    // If stderr's reader has left, the file is still written. If stdout's reader has left, SIGPIPE ends the program.
    const std::string run = "(sleep 0.3; " + tessera + " plan m.obj ";
    ASSERT_EQ(runShell(run + "--json p.json 2>&1 >/dev/null; echo $? >code) | true", folder_.path()).exitCode, 0);
    EXPECT_EQ(text("code"), "0\n");
    EXPECT_EQ(json("p.json").at("scene"), "m");
    const ProcessResult ended = runShell(run + "; echo $? >code) | true", folder_.path());
    EXPECT_EQ(text("code"), std::to_string(128 + SIGPIPE) + "\n");
    EXPECT_THAT(ended.err, testing::Not(testing::HasSubstr("error")));
}

void Output::expectInterruptionsLeaveNoTemporaries() {
    const int attempts = isWholeSweep() ? 12 : 4;
    std::signal(SIGINT, SIG_DFL); // a shell's background processes ignore it, and the program would inherit that
    // Writing takes most of the time of these small images, so some of the signals arrive during a write.
    int midWrites = 0;
    for (int attempt = 0; attempt < attempts; ++attempt) {
        const int signal = attempt % 2 == 0 ? SIGINT : SIGTERM;
        Process process({kProgram, "render", "room", "--size", "16x9", "--frames", "100000", "-o", "f%d.exr"},
                        {folder_.path(), {}, 60.0});
        const fs::path first = folder_.path() / "f3.exr";
        while (!fs::exists(first)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        // A different point of the loop each time, by a step that no period divides.
        std::this_thread::sleep_for(std::chrono::microseconds(1370 * attempt));
        for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path()))
            midWrites += isTemporary(entry.path().filename().string()) ? 1 : 0;
        process.send(signal);
        const ProcessResult result = process.wait();
        EXPECT_FALSE(result.exitCode.has_value());
        EXPECT_EQ(result.signal, signal);
        EXPECT_EQ(result.out + result.err, "");
        expectNoTemporaries();
        for (const auto& [name, contents] : files()) fs::remove(folder_.path() / name);
    }
    RecordProperty("signalsInTheMidstOfAWrite", midWrites);
}
TEST_F(Output, anInterruptedRunEndsByItsSignalAndNeverLeavesTemporaries) {
    expectInterruptionsLeaveNoTemporaries();
}
TEST_F(OutputSlow, anInterruptedRunEndsByItsSignalAndNeverLeavesTemporaries) {
    expectInterruptionsLeaveNoTemporaries();
}

} // namespace
} // namespace tessera::test
