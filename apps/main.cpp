#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <fcntl.h>
#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "apps/Commands.h"
#include "apps/ErrorLine.h"
#include "apps/HelpFormat.h"
#include "apps/Interrupt.h"
#include "apps/ParseMessage.h"
#include "apps/Version.h"
#include "base/Error.h"
#include "base/OneLine.h"
#include "renderer/frame/ComputedCache.h"

namespace {

using namespace tessera;
using namespace tessera::app;

constexpr const char* kFooter = R"(Examples
  tessera render hall -o hall.png                 the default scene as a picture
  tessera compare hall --size 640x360             do all techniques give the same picture?
  tessera plan hall                               what runs, what is left out and why
  tessera render model.glb -o model.exr           linear radiance, 32 bits a channel

Exit codes: 0 good, 1 failure while running or writing, 2 unusable input, 3 a tolerance missed.)";

/// Keeps freed memory in the process. A software rasteriser allocates and frees megabytes of vertices per frame;
/// returning them to the system and fetching zeroed pages again costs a third of the time of a small image of `hall`.
void keepFreedMemory() {
#ifdef __GLIBC__
    constexpr int kKeptBytes = 256 << 20;
    constexpr int kOwnMappingBytes = 32 << 20; // larger allocations use mmap and are returned
    mallopt(M_TRIM_THRESHOLD, kKeptBytes);
    mallopt(M_MMAP_THRESHOLD, kOwnMappingBytes);
#endif
}

/// Opens /dev/null read-only for closed standard streams. Otherwise the next opened file would get the descriptor, and
/// messages would be written into it.
void holdStandardStreams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF && open("/dev/null", O_RDONLY) == -1) return;
}

void configureLog(const GlobalOptions& options) {
    auto logger = spdlog::stderr_logger_st("tessera");
    logger->set_pattern("tessera: %l: %v");
    logger->set_level(options.quiet     ? spdlog::level::err
                      : options.verbose ? spdlog::level::debug
                                        : spdlog::level::warn);
    spdlog::set_default_logger(logger);
}

void printDriver(const gpu::Capabilities& gl, bool isVerbose) {
    if (isVerbose) fmt::print("context    {}\nvendor     {}\n", gl.contextWay, gl.vendor);
    fmt::print("renderer   {}{}\nOpenGL     {}\n", gl.renderer, gl.isSoftware ? " (software)" : "", gl.version);
    if (!isVerbose) return;
    fmt::print("GLSL       {}\nlimits     texture side {}, buffer texels {}, uniform block {} B, samples {}\n",
               gl.glslVersion, gl.maxTextureSize, gl.maxTextureBufferTexels, gl.maxUniformBlockBytes, gl.maxSamples);
}

/// Prints the versions of the program and the driver. A missing driver is an error only with --verbose.
int printVersion(const GlobalOptions& options) {
    std::unique_ptr<gpu::Context> context;
    std::string missing;
    try {
        context = makeContext(options);
    } catch (const std::runtime_error& error) {
        if (options.verbose) throw;
        missing = error.what();
    }
    fmt::print("tessera {}\ncommit     {}\n", TESSERA_VERSION, kCommit);
    if (context)
        printDriver(context->capabilities(), options.verbose);
    else
        fmt::print("OpenGL     none: {}\n", oneLine(missing));
    return kGood;
}

/// Prints an error as one line, although some texts, such as a shader compiler's log, have many.
int fail(const std::string& text, int code) {
    printProblem("error: " + text);
    return code;
}

/// Ends a program whose standard output cannot be written. A pipe closed by its reader (`tessera plan hall | head -1`)
/// is not reported as an error.
int failedOutput(int error) {
    if (error == EPIPE) endAsByClosedPipe();
    return fail(fmt::format("cannot write the output: {}{}", std::strerror(error),
                            error == ENOSPC || error == EDQUOT ? "; free some space" : ""),
                kFailed);
}

/// Flushes stdout: buffered output hides a full disk until then.
int flushed(int code) {
    if (code == kFailed || (std::fflush(stdout) == 0 && std::ferror(stdout) == 0)) return code;
    return failedOutput(errno);
}

/// "help render" is "render --help", and "help" alone "--help".
std::vector<const char*> withoutHelpCommand(std::vector<const char*> words) {
    if (words.size() > 1 && std::string_view(words[1]) == "help") {
        words.erase(words.begin() + 1);
        words.push_back("--help");
    }
    return words;
}

constexpr const char* kEmptyValue = "is empty; give a value";

/// Rejects empty option values: an unset shell variable must not make an option count as not given.
void refuseEmptyValues(CLI::App& app) {
    const CLI::Validator notEmpty([](const std::string& text) { return text.empty() ? kEmptyValue : ""; }, "");
    for (CLI::Option* option : app.get_options())
        if (option->get_items_expected_max() > 0) option->check(notEmpty);
    for (CLI::App* command : app.get_subcommands({})) refuseEmptyValues(*command);
}

/// Rejects what the parser would misread: the next word as the value of "--name=", and "=value" as that of "-n=value".
void refuseMisplacedEquals(const std::vector<const char*>& words) {
    for (const std::string_view word : words) {
        if (word == "--") return;
        if (word.starts_with("--") && word.find('=') == word.size() - 1)
            throw CLI::ValidationError(std::string(word.substr(0, word.size() - 1)), kEmptyValue);
        if (word.size() > 2 && word[0] == '-' && word[1] != '-' && word[2] == '=')
            throw CLI::ValidationError(std::string(word.substr(0, 2)), "takes its value behind a space, without '='");
    }
}

int runProgram(int argc, char** argv) {
    CLI::App app("Tessera renders scenes with many lights by several techniques, and checks that their pictures agree.",
                 "tessera");
    app.formatter(helpFormat());
    app.set_help_flag("-h,--help", "This text; also after a command");
    GlobalOptions global;
    bool version = false;
    addGlobalOptions(app, global);
    app.add_flag("--version", version, "The version, its commit, and the OpenGL driver that draws");
    app.fallthrough();
    Run run;
    addRenderCommand(app, global, run);
    addCompareCommand(app, global, run);
    addPlanCommand(app, global, run);
    addBenchCommand(app, global, run);
    addStressCommand(app, global, run);
    addScenesCommand(app, run);
    addViewCommand(app, global, run);
    addDemoCommand(app, global, run);
    addCompletionCommand(app, run);
    addManualCommand(app, run);
    app.footer(kFooter);
    refuseEmptyValues(app);
    const std::vector<const char*> words = withoutHelpCommand({argv, argv + argc});
    try {
        refuseMisplacedEquals(words);
        app.parse(int(words.size()), words.data());
    } catch (const CLI::Success& wanted) { // --help
        if (const std::string fault = unknownCommandOf(app, int(words.size()), words.data()); !fault.empty())
            return fail(fault, kBadInput);
        return app.exit(wanted);
    } catch (const CLI::ParseError& error) {
        return fail(parseMessage(app, error, int(words.size()), words.data()), kBadInput);
    }
    configureLog(global);
    if (version) return printVersion(global);
    if (!run) {
        fmt::print("{}", app.help());
        return kGood;
    }
    const int code = run();
    if (const std::string fault = frame::takeCacheFault(); !fault.empty() && !global.quiet)
        printProblem("note: " + fault);
    return code;
}

} // namespace

int main(int argc, char** argv) {
    try {
        holdStandardStreams();
        keepFreedMemory();
        cleanUpWhenInterrupted();
        return flushed(runProgram(argc, argv));
    } catch (const tessera::InputError& error) {
        return fail(error.what(), kBadInput);
    } catch (const std::bad_alloc&) {
        return fail("the memory is not enough for this; give a smaller scene or picture, or close other programs",
                    kFailed);
    } catch (const std::system_error& error) {
        return std::ferror(stdout) != 0 ? failedOutput(error.code().value()) : fail(error.what(), kFailed);
    } catch (const std::exception& error) {
        return fail(error.what(), kFailed);
    }
}
