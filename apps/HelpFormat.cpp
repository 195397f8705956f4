#include "apps/HelpFormat.h"

#include <sstream>

#include <fmt/format.h>

namespace tessera::app {

namespace {

constexpr std::size_t kNameColumns = 26;
constexpr std::size_t kColumns = 100; // wider lines are hard to read, narrower ones break the examples

std::vector<std::string> wrapped(const std::string& text, std::size_t columns) {
    std::vector<std::string> lines(1);
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (!lines.back().empty() && lines.back().size() + 1 + word.size() > columns) lines.emplace_back();
        lines.back() += (lines.back().empty() ? "" : " ") + word;
    }
    return lines;
}

std::string entry(const std::string& name, const std::string& description) {
    const bool fits = name.size() + 4 <= kNameColumns; // 4: the indent and the minimum gap
    std::string text = fits ? "" : fmt::format("  {}\n", name);
    std::string head = fits ? name : "";
    for (const std::string& line : wrapped(description, kColumns - kNameColumns)) {
        text += fmt::format("  {:<{}}{}\n", head, kNameColumns - 2, line);
        head.clear();
    }
    return text;
}

class HelpFormat final : public CLI::Formatter {
public:
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
        std::string text = make_description(app) + make_usage(app, name) + make_positionals(app);
        for (const std::string& group : app->get_groups()) {
            text += make_group(group, false, app->get_options([&group](const CLI::Option* option) {
                return option->get_group() == group && option->nonpositional();
            }));
        }
        if (const CLI::App* program = app->get_parent()) {
            text += make_group("Program", false, program->get_options([program](const CLI::Option* option) {
                return option != program->get_help_ptr() && !option->check_lname("version");
            }));
        }
        text += make_subcommands(app, mode);
        const std::string footer = app->get_footer();
        return footer.empty() ? text : text + "\n" + footer + "\n";
    }

    std::string make_group(std::string group, bool isPositional,
                           std::vector<const CLI::Option*> options) const override {
        if (options.empty()) return "";
        std::string text = "\n" + group + ":\n";
        for (const CLI::Option* option : options) text += make_option(option, isPositional);
        return text;
    }

    std::string make_option(const CLI::Option* option, bool isPositional) const override {
        const std::string type = isPositional || option->get_type_size() == 0 ? "" : " " + option->get_type_name();
        const std::string name = isPositional ? option->get_type_name() : option->get_name(false, true);
        return entry(spaced(name) + type, option->get_description());
    }

    std::string make_subcommand(const CLI::App* command) const override {
        return entry(command->get_name(), command->get_description());
    }

    std::string make_usage(const CLI::App* app, std::string name) const override {
        return "\nUsage: " + usageOf(*app, name) + "\n";
    }

private:
    /// "-o, --output" for CLI11's "-o,--output".
    static std::string spaced(std::string names) {
        const std::size_t comma = names.find(',');
        if (comma != std::string::npos) names.insert(comma + 1, " ");
        return names;
    }
};

} // namespace

std::shared_ptr<CLI::Formatter> helpFormat() {
    return std::make_shared<HelpFormat>();
}

std::string usageOf(const CLI::App& app, const std::string& name) {
    std::string line = name;
    if (!app.get_subcommands({}).empty()) line += " COMMAND";
    for (const CLI::Option* option : app.get_options({})) {
        const std::string type = option->get_type_name() + (option->get_expected_max() > 1 ? "..." : "");
        if (option->get_positional())
            line += option->get_required() ? " " + type : " [" + type + "]";
        else if (option->get_required())
            line += fmt::format(" -{} {}", option->get_snames().front(), type);
    }
    return line + " [options]";
}

} // namespace tessera::app
