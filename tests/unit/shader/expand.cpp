#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/Error.h"
#include "renderer/shader/Preprocess.h"
#include "tests/support/ErrorText.h"
#include "tests/support/TempFolder.h"

namespace tessera::shader {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class Expand : public testing::Test {
protected:
    ExpandedSource expanded(const std::string& entry, const Defines& defines = {}) {
        return expand(SourceTree(folder.path()), entry, defines);
    }
    std::string fault(const std::string& entry, const Defines& defines = {}) {
        return test::errorText<InputError>([&] { expanded(entry, defines); });
    }
    /// Returns the expansion of main.frag with this text.
    ExpandedSource ofMain(const std::string& text, const Defines& defines = {}) {
        folder.write("main.frag", text);
        return expanded("main.frag", defines);
    }
    /// Writes an entry that calls a hook, and the hook's file with this text. Returns the file's path.
    std::string writeHooked(const std::string& hook) {
        folder.write("main.frag", "#include \"lib/material/hook_interface.glsl\"\n");
        folder.write("lib/material/hook_interface.glsl", "\n");
        return folder.write("tint.glsl", hook).string();
    }
    test::TempFolder folder;
};

std::size_t count(const std::string& text, std::string_view piece) {
    std::size_t found = 0;
    for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++found;
    return found;
}

TEST_F(Expand, versionAndDefinesComeFirst) {
    EXPECT_EQ(ofMain("void main() {}\n", {{"TILE", "16"}, {"SHADOWS", ""}}).text,
              "#version 450 core\n#define TILE 16\n#define SHADOWS\n#line 1 0\nvoid main() {}\n");
}

TEST_F(Expand, anIncludeIsFramedByLineDirectives) {
    folder.write("passes/main.frag", "float a;\n#include \"lib/b.glsl\"\nfloat c;\n");
    folder.write("lib/b.glsl", "float b;\n");
    const ExpandedSource source = expanded("passes/main.frag");
    EXPECT_EQ(source.text, "#version 450 core\n#line 1 0\nfloat a;\n#line 1000001 1\nfloat b;\n#line 3 0\nfloat c;\n");
    EXPECT_THAT(source.files, ElementsAre("passes/main.frag", "lib/b.glsl"));
}

TEST_F(Expand, aFileBesideTheIncludingOneIsFound) {
    folder.write("lib/a.glsl", "#include \"b.glsl\"\n#include \"../shared/c.h\"\n");
    folder.write("lib/b.glsl", "float b;\n");
    folder.write("shared/c.h", "float c;\n");
    EXPECT_THAT(ofMain("#include \"lib/a.glsl\"\n").files,
                ElementsAre("main.frag", "lib/a.glsl", "lib/b.glsl", "shared/c.h"));
}

TEST_F(Expand, aPathAsCppSeesItMeansTheSameFile) {
    folder.write("shared/a.h", "#pragma once\nfloat a;\n");
    EXPECT_EQ(count(ofMain("#include \"shared/a.h\"\n#include \"shaders/shared/a.h\"\n").text, "float a;"), 1u);
}

TEST_F(Expand, aPathOutOfTheTreeIsNotFollowed) {
    folder.write("tree/main.frag", "#include \"../secret.glsl\"\n");
    folder.write("secret.glsl", "float secret;\n");
    EXPECT_THROW(expand(SourceTree(folder.path() / "tree"), "main.frag"), InputError);
}

TEST_F(Expand, aFileWithPragmaOnceIsExpandedExactlyOnce) {
    folder.write("a.glsl", "#pragma once\nfloat a;\n");
    folder.write("b.glsl", "#include \"a.glsl\"\nfloat b;\n");
    const std::string text = ofMain("#include \"a.glsl\"\n#include \"b.glsl\"\n#include \"a.glsl\"\n").text;
    EXPECT_EQ(count(text, "float a;"), 1u);
}

TEST_F(Expand, aFileWithoutPragmaOnceIsExpandedAgain) {
    folder.write("a.glsl", "X\n");
    EXPECT_EQ(count(ofMain("#include \"a.glsl\"\n#include \"a.glsl\"\n").text, "X\n"), 2u);
}

TEST_F(Expand, anIncludeInAConditionalNeverSwallowsALaterOne) {
    folder.write("main.frag",
                 "#ifdef NEVER_DEFINED\n#include \"a.glsl\"\n#endif\n#include \"a.glsl\"\n#include \"a.glsl\"\n");
    folder.write("a.glsl", "#pragma once\nfloat a;\n");
    const std::string text = expanded("main.frag").text;
    EXPECT_EQ(count(text, "float a;"), 2u);
    EXPECT_EQ(count(text, "#ifndef TESSERA_ONCE_1\n#define TESSERA_ONCE_1\n"), 2u);
}

TEST_F(Expand, anIncludeInACommentIsNotFollowed) {
    folder.write("main.frag",
                 "// #include \"no.glsl\"\n/* #include \"no.glsl\"\n#include \"no.glsl\"\n*/\n"
                 "// continued \\\n#include \"no.glsl\"\nfloat a; /* b */ // /*\n#include \"a.glsl\" // yes\n");
    folder.write("a.glsl", "float included;\n");
    const ExpandedSource source = expanded("main.frag");
    EXPECT_THAT(source.files, ElementsAre("main.frag", "a.glsl"));
    EXPECT_THAT(source.text, HasSubstr("// #include \"no.glsl\"\n"));
}

TEST_F(Expand, includesOfTheCppPartOfASharedHeaderAreNotFollowed) {
    folder.write("shared/a.h", "#pragma once\n#ifdef __cplusplus\n#include <glm/glm.hpp>\n#include \"renderer/No.h\"\n"
                               "namespace a {\n#else\n#include \"b.h\"\n#endif\nstruct S { float x; };\n"
                               "#ifndef __cplusplus\n#include \"c.h\"\n#endif\n#if defined( __cplusplus )\n"
                               "#include <vector>\n}\n#endif\n");
    folder.write("shared/b.h", "float b;\n");
    folder.write("shared/c.h", "float c;\n");
    const ExpandedSource source = expanded("shared/a.h");
    EXPECT_THAT(source.files, ElementsAre("shared/a.h", "shared/b.h", "shared/c.h"));
    EXPECT_THAT(source.text, HasSubstr("#ifdef __cplusplus\n\n\nnamespace a {\n#else\n"));
    EXPECT_THAT(source.text, Not(HasSubstr("glm")));
}

TEST_F(Expand, otherPreprocessorLinesPassThrough) {
    const std::string lines =
        "#extension GL_ARB_x : enable\n#if A && \\\n    B\n#define F(x) \\\n  (x)\n#elif C\n#endif\n"
        "#pragma optimize(on)\n#undef F\n";
    EXPECT_EQ(ofMain(lines).text, "#version 450 core\n#line 1 0\n" + lines);
}

TEST_F(Expand, aMissingIncludeIsNamedWithItsPlace) {
    folder.write("main.frag", "\n#include \"lib/a.glsl\"\n");
    folder.write("lib/a.glsl", "float a;\n\n#include \"brfd.glsl\"\n");
    EXPECT_EQ(fault("main.frag"),
              "shaders/lib/a.glsl:3: cannot include 'brfd.glsl': no such file below shaders/ or beside "
              "the including file, in " +
                  folder.path().string());
}

TEST_F(Expand, aMissingEntryIsNamed) {
    EXPECT_THAT(fault("passes/no.frag"), HasSubstr("shaders/passes/no.frag: "));
}

TEST_F(Expand, aCycleIsNamedWithItsWholeWay) {
    folder.write("main.frag", "#include \"a.glsl\"\n");
    folder.write("a.glsl", "#pragma once\n#include \"b.glsl\"\n");
    folder.write("b.glsl", "#pragma once\n\n#include \"a.glsl\"\n");
    EXPECT_EQ(fault("main.frag"),
              "shaders/b.glsl:3: the #include of 'a.glsl' closes a cycle: a.glsl -> b.glsl -> a.glsl; "
              "move what both need to a third file");
}

TEST_F(Expand, aMalformedIncludeIsRefused) {
    for (const char* line :
         {"#include <a.glsl>", "#include a.glsl", "#include \"a.glsl", "#include \"\"", "#include"}) {
        folder.write("main.frag", std::string(line) + "\n");
        EXPECT_THAT(fault("main.frag"), HasSubstr("shaders/main.frag:1: malformed #include")) << line;
    }
    folder.write("main.frag", "#include \"main.frag\" /* open\n*/\n");
    EXPECT_THAT(fault("main.frag"), HasSubstr("must end on its line"));
}

TEST_F(Expand, anotherVersionIsRefused) {
    EXPECT_EQ(ofMain("#version 450 core\nfloat a;\n").text, "#version 450 core\n#line 1 0\n\nfloat a;\n");
    folder.write("main.frag", "#version 330\n");
    EXPECT_THAT(fault("main.frag"), HasSubstr("shaders/main.frag:1: every shader is '#version 450 core'"));
}

TEST_F(Expand, windowsLineEndsNeverReachTheDriver) {
    folder.write("main.frag", "#include \"a.glsl\"\r\nfloat b;\r\n");
    folder.write("a.glsl", "#pragma once\r\nfloat a;");
    EXPECT_EQ(expanded("main.frag").text,
              "#version 450 core\n#line 1 0\n#line 1000001 1\n\nfloat a;\n#line 2 0\nfloat b;\n");
}

TEST(SourceTree, aMissingFolderIsNamed) {
    EXPECT_THAT(test::errorText<InputError>([] { SourceTree("no/such/folder"); }),
                HasSubstr("no/such/folder: no such shader folder"));
}

TEST(SourceTree, embeddedFilesAreNotReadFromDisk) {
    const SourceTree tree = SourceTree::embedded();
    EXPECT_TRUE(tree.isEmbedded());
    EXPECT_FALSE(tree.newestChange());
    EXPECT_FALSE(tree.read("no/such.glsl"));
}

TEST_F(Expand, aHookStandsBehindAllElseWithItsBlockAndOnlyWhereItIsCalled) {
    const std::string hook = folder.write("scene/tint.glsl", "void hookSurface() {}\n").string();
    const Defines defines{{"HOOK_HASH", "7u"}, {"HOOK_FILE", hook}, {"HOOK_PARAMETERS", "speed height"}};
    folder.write("main.frag", "#include \"lib/material/hook_interface.glsl\"\nvoid main() {}\n");
    folder.write("lib/material/hook_interface.glsl", "void hookSurface();\n");
    folder.write("other.frag", "void main() {}\n");
    const ExpandedSource source = expanded("main.frag", defines);
    EXPECT_EQ(
        source.text,
        "#version 450 core\n#define HOOK_HASH 7u\n#line 1 0\n#line 1000001 1\nvoid hookSurface();\n#line 2 0\n"
        "void main() {}\n#if HOOKED\n#line 3000001 3\nlayout(std140, binding = UNIFORM_HOOK) uniform HookBlock\n{\n"
        "    float timeSeconds;\n    float speed;\n    float height;\n} hook;\n#line 2000001 2\n"
        "void hookSurface() {}\n#endif\n");
    EXPECT_THAT(source.files,
                ElementsAre("main.frag", "lib/material/hook_interface.glsl", hook, hook + " (its parameters)"));
    EXPECT_EQ(mapLog("0:2000001(1): error: x", source.files), hook + ":1: error: x");
    EXPECT_EQ(mapLog("0:3000004(1): error: x", source.files), hook + " (its parameters):4: error: x");
    EXPECT_EQ(expanded("other.frag", defines).text,
              "#version 450 core\n#define HOOK_HASH 7u\n#line 1 0\nvoid main() {}\n");
    EXPECT_THAT(expanded("main.frag", {{"HOOK_HASH", "7u"}}).text, Not(HasSubstr("HookBlock")));
}

TEST_F(Expand, aHookIsPreparedBeforeAProgramTakesItOrRefused) {
    const std::string hook = writeHooked("void hookSurface()\r\n{}");
    SourceTree tree(folder.path());
    tree.prepareHooks([](const std::string&, std::string_view) { return std::string("prepared"); });
    EXPECT_THAT(expand(tree, "main.frag", {{"HOOK_FILE", hook}}).text, HasSubstr("prepared#endif"));
    tree.prepareHooks([&](const std::string& file, std::string_view seen) -> std::string {
        EXPECT_EQ(seen, "void hookSurface()\n{}\n");
        throw InputError(file + ": not this one");
    });
    EXPECT_EQ(test::errorText<InputError>([&] {
                  expand(tree, "main.frag", {{"HOOK_FILE", hook}});
              }),
              hook + ": not this one");
    EXPECT_NO_THROW(expand(tree, "main.frag", {}));
}

TEST_F(Expand, aHookThatIsNotThereIsNamed) {
    const std::string missing = writeHooked("");
    std::filesystem::remove(missing);
    EXPECT_EQ(fault("main.frag", {{"HOOK_FILE", missing}}),
              missing + ": the scene's hook is not there any more; bring it back, or load the scene again");
}

} // namespace
} // namespace tessera::shader
