#include "renderer/shader/ProgramLibrary.h"

#include <gmock/gmock.h>

#include "base/Error.h"
#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/Commands.h"
#include "tests/support/GlContext.h"
#include "tests/support/TempFolder.h"

namespace tessera::shader {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class ProgramLibraryTest : public test::GlTest {
protected:
    ProgramLibraryTest() {
        folder.write("answer.comp", "#include \"lib/answer.glsl\"\nlayout(local_size_x = 1) in;\n"
                                    "layout(binding = 0, std430) buffer Answer { float answer[]; };\n"
                                    "void main() { answer[0] = answerOf() + float(BIAS); }\n");
        writeAnswer("return 40.0;");
    }
    void writeAnswer(const std::string& body) {
        folder.write("lib/answer.glsl", "#pragma once\n\nfloat answerOf() {\n    " + body + "\n}\n");
    }
    ProgramDesc desc(const std::string& bias) { return {"answer", "", "", "answer.comp", {{"BIAS", bias}}}; }
    float answer(const gpu::Program& program) {
        const gpu::Buffer result("answer", sizeof(float));
        gpu::useProgram(program);
        gpu::bindStorageBuffer(0, result);
        gpu::dispatch(1);
        gpu::memoryBarrier(graph::Barrier::TransferOrUpdate);
        return result.downloadAs<float>(1)[0];
    }
    test::TempFolder folder;
};

TEST_F(ProgramLibraryTest, everyVariantIsCompiledExactlyOnce) {
    ProgramLibrary library{SourceTree(folder.path())};
    const gpu::Program& two = library.get(desc("2"));
    const gpu::Program& three = library.get(desc("3"));
    EXPECT_EQ(&library.get(desc("2")), &two);
    EXPECT_EQ(library.size(), 2u);
    EXPECT_EQ(answer(two), 42.0f);
    EXPECT_EQ(answer(three), 43.0f);
}

TEST_F(ProgramLibraryTest, faultsAreReportedWithFileAndLine) {
    writeAnswer("return undeclaredName;");
    ProgramLibrary library{SourceTree(folder.path())};
    try {
        library.get(desc("2"));
        FAIL() << "expected a ShaderError";
    } catch (const gpu::ShaderError& error) {
        EXPECT_EQ(error.program(), "answer [BIAS=2]");
        EXPECT_THAT(error.what(), HasSubstr("shaders/lib/answer.glsl:4: error"));
    }
    EXPECT_EQ(library.size(), 0u);
}

TEST_F(ProgramLibraryTest, warningsStandBehindTheErrorWithTheirOwnFileAndLine) {
    folder.write("lib/answer.glsl", "#pragma once\n\nfloat answerOf() {\n    float unset;\n    return unset;\n}\n");
    folder.write("answer.comp", "#include \"lib/answer.glsl\"\nlayout(local_size_x = 1) in;\nvoid main() {\n"
                                "  wrong = answerOf();\n}\n");
    ProgramLibrary library{SourceTree(folder.path())};
    try {
        library.get(desc("2"));
        FAIL() << "expected a ShaderError";
    } catch (const gpu::ShaderError& error) {
        const std::string text = error.what();
        const std::size_t fault = text.find("shaders/answer.comp:4: error");
        ASSERT_NE(fault, std::string::npos) << text;
        const std::size_t warning = text.find(": warning"); // drivers need not give one
        if (warning == std::string::npos) return;
        EXPECT_GT(warning, fault) << text;
        EXPECT_NE(text.find("shaders/lib/answer.glsl:5: warning"), std::string::npos) << text;
    }
}

TEST_F(ProgramLibraryTest, linesAfterAnIncludeAreReportedRight) {
    folder.write("answer.comp",
                 "#include \"lib/answer.glsl\"\nlayout(local_size_x = 1) in;\nvoid main() {\n  wrong = 1;\n}\n");
    ProgramLibrary library{SourceTree(folder.path())};
    try {
        library.get(desc("2"));
        FAIL() << "expected a ShaderError";
    } catch (const gpu::ShaderError& error) {
        EXPECT_THAT(error.what(), HasSubstr("shaders/answer.comp:4: error"));
    }
}

TEST_F(ProgramLibraryTest, warmingKeepsTheGoodOnesAndReportsTheFirstFault) {
    folder.write("broken.comp", "void main() { wrong = 1; }\n");
    ProgramLibrary library{SourceTree(folder.path())};
    const std::vector<ProgramDesc> descs{
        desc("1"), {"missing", "", "", "no.comp", {}}, {"broken", "", "", "broken.comp", {}}, desc("2"), desc("1")};
    EXPECT_THROW(library.warm(descs), InputError);
    EXPECT_EQ(library.size(), 2u);
    EXPECT_EQ(answer(library.get(desc("2"))), 42.0f);
    EXPECT_THROW(library.warm(std::vector{descs[2]}), gpu::ShaderError);
}

TEST_F(ProgramLibraryTest, reloadingReplacesTheProgramBehindItsReference) {
    ProgramLibrary library{SourceTree(folder.path())};
    const gpu::Program& program = library.get(desc("2"));
    writeAnswer("return 50.0;");
    const Reloading done = library.reload();
    EXPECT_THAT(done.faults, IsEmpty());
    EXPECT_EQ(done.programs, 1u);
    EXPECT_EQ(answer(program), 52.0f);
    EXPECT_EQ(library.reload().programs, 0u) << "nothing has changed since";
    EXPECT_EQ(library.reloaded(), 1u);
}

TEST_F(ProgramLibraryTest, aBrokenEditKeepsTheLastGoodProgram) {
    ProgramLibrary library{SourceTree(folder.path())};
    const gpu::Program& program = library.get(desc("2"));
    writeAnswer("return 50.0");
    EXPECT_THAT(library.reload().faults,
                ElementsAre(AllOf(Field(&ShaderFault::text,
                                        AllOf(HasSubstr("shaders/lib/answer.glsl:5: error"), Not(HasSubstr("BIAS")))),
                                  Field(&ShaderFault::program, "answer [BIAS=2]"))));
    EXPECT_EQ(answer(program), 42.0f);
    std::filesystem::remove(folder.path() / "lib/answer.glsl");
    EXPECT_THAT(library.reload().faults,
                ElementsAre(AllOf(Field(&ShaderFault::text, HasSubstr("shaders/answer.comp:1: cannot include")),
                                  Field(&ShaderFault::program, ""))));
    EXPECT_EQ(answer(program), 42.0f);
    writeAnswer("return 60.0;");
    EXPECT_THAT(library.reload().faults, IsEmpty());
    EXPECT_EQ(answer(program), 62.0f);
}

TEST_F(ProgramLibraryTest, aChangeOfAFileIsReportedOnce) {
    ProgramLibrary library{SourceTree(folder.path())};
    EXPECT_FALSE(library.sourcesChanged());
    const auto file = folder.path() / "answer.comp";
    std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + std::chrono::seconds(5));
    EXPECT_TRUE(library.sourcesChanged());
    EXPECT_FALSE(library.sourcesChanged());
    EXPECT_TRUE(library.watchesFiles());
    ProgramLibrary embedded{SourceTree::embedded()};
    EXPECT_FALSE(embedded.sourcesChanged());
    EXPECT_FALSE(embedded.watchesFiles());
}

} // namespace
} // namespace tessera::shader
