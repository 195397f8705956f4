// Tables of the documentation that repeat tables of the program.
#include "tests/unit/docs/Tables.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/Settings.h"
#include "scenes/AnimatedProperties.h"
#include "scenes/Light.h"
#include "tests/support/GBufferBounds.h"

namespace tessera {
namespace {

using test::Rows;

std::string code(std::string_view text) {
    return fmt::format("`{}`", text);
}

/// "4 + 9 + 6 + 6 = 25"
std::string bits(const frame::FieldWidths& widths) {
    std::string terms;
    int sum = 0;
    for (const int width : widths) {
        if (width == 0) break;
        terms += fmt::format("{}{}", terms.empty() ? "" : " + ", width);
        sum += width;
    }
    return fmt::format("{} = {}", terms, sum);
}

void expectTable(const char* document, const std::vector<std::string>& head, const Rows& rows) {
    const std::string table = test::markdownTable(head, rows);
    EXPECT_TRUE(test::holdsTable(test::textOf(test::kRepository / document), table))
        << document << " should hold exactly\n"
        << table;
}

TEST(Documentation, theChannelsOfTheGBufferAreThoseOfTheProgram) {
    Rows rows;
    for (const frame::ChannelInfo& info : frame::channelTable()) {
        rows.push_back({code(info.name), std::string(info.meaning), std::string(info.fields), bits(info.packed),
                        bits(info.slim), std::string(info.needed)});
    }
    expectTable("docs/how-it-works.md",
                {"channel", "holds", "fields of `packed` and `slim`", "`packed` bits", "`slim` bits", "allocated for"},
                rows);
}

TEST(Documentation, theMarksOfTheGBufferAreThoseOfTheProgram) {
    Rows rows;
    for (const frame::MarkInfo& info : frame::markTable())
        rows.push_back({code(info.name), std::string(info.meaning), std::to_string(info.bits),
                        code(frame::channelTable()[std::size_t(info.beside)].name), std::string(info.needed)});
    expectTable("docs/how-it-works.md", {"mark", "holds", "bits", "or beside", "allocated for"}, rows);
}

TEST(Documentation, theErrorBoundsOfTheGBufferAreThoseOfTheProgram) {
    const std::vector<frame::FieldBound> packed = frame::fieldBounds(frame::Encoding::Packed),
                                         slim = frame::fieldBounds(frame::Encoding::Slim);
    const auto name = [](const frame::FieldBound& bound) {
        return frame::channelTable()[std::size_t(bound.channel)].name;
    };
    const auto text = [](const frame::FieldBound& bound) {
        return fmt::format("{:.2g}{}", bound.bound, bound.unit == "degrees" ? "°" : "");
    };
    Rows rows;
    for (std::size_t i = 0; i < packed.size(); ++i) {
        const std::string_view unit = packed[i].unit == "degrees" ? "" : packed[i].unit;
        rows.push_back({code(name(packed[i])),
                        fmt::format("{}{}{}", packed[i].quantity, unit.empty() ? "" : ", ", unit), text(packed[i]),
                        text(slim[i])});
    }
    expectTable("docs/numerics.md", {"channel", "error of", "`packed` at most", "`slim` at most"}, rows);
}

TEST(Documentation, theTechniquesAreThoseOfTheProgram) {
    Rows rows;
    for (const engine::TechniqueInfo& info : engine::techniqueTable())
        rows.push_back({code(info.name), std::string(describe(info.geometry)), std::string(info.lighting)});
    expectTable("README.md", {"technique", "geometry", "lighting"}, rows);
}

TEST(Documentation, theDebugViewsAreThoseOfTheProgram) {
    Rows rows;
    for (const frame::DebugViewInfo& info : frame::debugViewTable())
        if (!info.needsGBuffer)
            rows.push_back({info.key ? std::to_string(info.key) : "", code(info.name), std::string(info.meaning)});
    expectTable("docs/command-line.md", {"number", "name", "shows"}, rows);
}

template <typename Table>
std::string namesIn(const Table& table) {
    std::string names;
    for (const auto& row : table) names += (names.empty() ? "" : ", ") + code(row.name);
    return names;
}

TEST(Documentation, theAnimatedPropertiesAreThoseOfTheProgram) {
    using scenes::AnimatedOwner;
    const std::map<AnimatedOwner, std::string> owners{{AnimatedOwner::Node, "a node"},
                                                      {AnimatedOwner::Weights, "a node's mesh"},
                                                      {AnimatedOwner::Light, "a light"},
                                                      {AnimatedOwner::Material, "a material"},
                                                      {AnimatedOwner::Texture, "a material's texture"},
                                                      {AnimatedOwner::Camera, "a camera"}};
    constexpr std::string_view kExtensions = "extensions/";
    Rows rows; // one per owner and extension; the program's table keeps their properties together
    for (const scenes::AnimatedPropertyInfo& info : scenes::animatedProperties()) {
        std::string_view path = info.path;
        std::string extension;
        if (path.starts_with(kExtensions)) {
            path.remove_prefix(kExtensions.size());
            extension = code(path.substr(0, path.find('/')));
            path.remove_prefix(path.find('/') + 1);
        }
        const std::string cell =
            fmt::format("{} ({})", code(path), info.width > 0 ? std::to_string(info.width) : "one a morph target");
        const std::string& owner = owners.at(info.owner);
        if (rows.empty() || rows.back()[0] != owner || rows.back()[1] != extension)
            rows.push_back({owner, extension, cell});
        else
            rows.back()[2] += ", " + cell;
    }
    expectTable("docs/animation.md", {"of", "extension", "paths, and how many numbers each has"}, rows);
}

TEST(Documentation, everyMemberWithKeyframesHasARow) {
    const std::string text = test::textOf(test::kRepository / "docs" / "scene-format.md");
    for (const scenes::LightKeyedInfo& member : scenes::keyedMembers().subspan(1)) // "animation" moves the position
        EXPECT_NE(text.find("\n| " + code(member.name) + " |"), std::string::npos) << member.name;
}

TEST(Documentation, everySettingHasARow) {
    const std::string text = test::textOf(test::kRepository / "docs" / "command-line.md");
    for (const engine::Setting& setting : engine::settingTable())
        EXPECT_TRUE(text.find(fmt::format("| `{}` |", setting.flag)) != text.npos ||
                    text.find(fmt::format("| `{} ", setting.flag)) != text.npos)
            << "docs/command-line.md should have a row of " << setting.flag;
}

TEST(Documentation, theNumbersThatOptionsAndSizesOfLightsTakeAreThoseOfTheProgram) {
    std::istringstream lines(test::textOf(test::kRepository / "docs" / "command-line.md"));
    std::map<std::string, std::string> rows;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("| `--")) rows[line.substr(3, line.find_first_of(" `", 3) - 3)] = line;
    for (const engine::Setting& setting : engine::settingTable())
        EXPECT_NE(rows[std::string(setting.flag)].find(setting.range()), std::string::npos)
            << "the row of " << setting.flag << " should hold " << setting.range();
    std::string text = test::textOf(test::kRepository / "docs" / "scene-format.md");
    std::ranges::replace(text, '\n', ' ');
    static_assert(scenes::kMostRadiusMetres == 1e6 && scenes::kMostAngularRadiusDegrees == 80.0);
    EXPECT_NE(text.find("`radius` in metres (`point`, `spot`, at most 1,000,000)"), std::string::npos);
    EXPECT_NE(text.find("to the edge, at most 80)"), std::string::npos);
}

TEST(Documentation, theNamesThatOptionsTakeAreThoseOfTheProgram) {
    const std::string text = test::textOf(test::kRepository / "docs" / "command-line.md");
    for (const std::string& row : {"| `--technique` | " + namesIn(engine::techniqueTable()) + " (",
                                   "| `--culling` | " + namesIn(culling::methodTable()) + " (",
                                   "| `--cull-on` | " + namesIn(culling::builderTable()) + " (",
                                   "| `--light-on` | " + namesIn(frame::lightingStageTable()) + " (",
                                   "| `--layout` | " + namesIn(frame::layoutTable()) + " (",
                                   "| `--tonemap` | " + namesIn(frame::toneMapTable()) + " ("}) {
        EXPECT_NE(text.find(row), std::string::npos) << "docs/command-line.md should have a row that begins " << row;
    }
}

} // namespace
} // namespace tessera
