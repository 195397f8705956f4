#include <exception>

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "apps/Commands.h"
#include "scenes/Error.h"
#include "scenes/Names.h"

namespace {

using namespace tessera;
using namespace tessera::app;

constexpr const char* kFooter = R"(Examples
  tessera render hall -o hall.png                 the default scene as a picture
  tessera compare hall --size 640x360             do all techniques give the same picture?
  tessera plan hall                               what runs, what is left out and why
  tessera render model.glb -o model.exr           linear radiance, 32 bits a channel

Exit codes: 0 good, 1 failure while running or writing, 2 unusable input, 3 a tolerance missed.)";

void configureLog(const GlobalOptions& options) {
    auto logger = spdlog::stderr_logger_st("tessera");
    logger->set_pattern("tessera: %l: %v");
    logger->set_level(options.quiet     ? spdlog::level::err
                      : options.verbose ? spdlog::level::debug
                                        : spdlog::level::warn);
    spdlog::set_default_logger(logger);
}

int printVersion(const GlobalOptions& options) {
    fmt::print("tessera {}\n", TESSERA_VERSION);
    if (!options.verbose) return kGood;
    const std::unique_ptr<gpu::Context> context = makeContext(options);
    const gpu::Capabilities& gl = context->capabilities();
    fmt::print("context    {}\nvendor     {}\nrenderer   {}{}\nOpenGL     {}\nGLSL       {}\n", gl.contextWay,
               gl.vendor, gl.renderer, gl.isSoftware ? " (software)" : "", gl.version, gl.glslVersion);
    fmt::print("limits     texture side {}, buffer texels {}, uniform block {} B, samples {}\n", gl.maxTextureSize,
               gl.maxTextureBufferTexels, gl.maxUniformBlockBytes, gl.maxSamples);
    return kGood;
}

/// One line for what the parser objects to; a mistyped command is answered with the nearest ones.
std::string parseMessage(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
    std::vector<std::string_view> commands;
    for (const CLI::App* command : app.get_subcommands({})) commands.push_back(command->get_name());
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word.empty() || word.front() == '-') continue;
        if (std::find(commands.begin(), commands.end(), word) != commands.end()) break;
        return fmt::format("unknown command '{}': {}", word, suggestNames(word, commands));
    }
    std::string text = error.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text + " (see --help)";
}

int fail(const std::string& text, int code) {
    // An error is one line, whatever its origin.
    std::string line = text;
    while (!line.empty() && line.back() == '\n') line.pop_back();
    fmt::print(stderr, "tessera: error: {}\n", line);
    return code;
}

int runProgram(int argc, char** argv) {
    CLI::App app("Tessera renders scenes with very many lights, by several techniques that must agree, and proves it.",
                 "tessera");
    app.footer(kFooter);
    app.get_formatter()->column_width(26);
    GlobalOptions global;
    bool version = false;
    addGlobalOptions(app, global);
    app.add_flag("--version", version, "The version; with --verbose also what OpenGL says of itself");
    app.fallthrough();
    Run run;
    addRenderCommand(app, global, run);
    addCompareCommand(app, global, run);
    addPlanCommand(app, global, run);
    addScenesCommand(app, run);
    addDemoCommand(app, global, run);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& wanted) { // --help
        return app.exit(wanted);
    } catch (const CLI::ParseError& error) {
        return fail(parseMessage(app, error, argc, argv), kBadInput);
    }
    configureLog(global);
    if (version) return printVersion(global);
    if (!run) {
        fmt::print("{}", app.help());
        return kGood;
    }
    return run();
}

} // namespace

int main(int argc, char** argv) {
    try {
        return runProgram(argc, argv);
    } catch (const tessera::InputError& error) {
        return fail(error.what(), kBadInput);
    } catch (const std::exception& error) {
        return fail(error.what(), kFailed);
    }
}
