#include "viewer/session/EnvironmentJob.h"

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "scenes/Defaults.h"
#include "scenes/Load.h"
#include "shaders/shared/environment.h"
#include "tests/support/EnvironmentVariable.h"
#include "tests/support/TempFolder.h"
#include "viewer/session/OpenScene.h"

namespace tessera::viewer {
namespace {

/// An empty cache of filtered environments.
class EmptyCache {
public:
    bool isEmpty() const {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path()))
            if (entry.is_regular_file()) return false;
        return true;
    }

private:
    tessera::test::TempFolder folder_;
    tessera::test::EnvironmentVariable variable_{"XDG_CACHE_HOME", folder_.path().c_str()};
};

class EnvironmentJobTest : public testing::Test {
protected:
    ChosenEnvironment chosen(const std::string& name) {
        job_.start(name);
        EXPECT_EQ(job_.choice(), name);
        std::unique_lock lock(mutex_);
        EXPECT_TRUE(changed_.wait_for(lock, std::chrono::minutes(5), [this] { return results_ > taken_; }));
        ++taken_; // dropped results are not reported
        EXPECT_TRUE(job_.hasResult());
        std::optional<ChosenEnvironment> result = job_.take();
        EXPECT_FALSE(job_.hasResult());
        EXPECT_EQ(job_.choice(), "");
        return result.value_or(ChosenEnvironment());
    }
    EnvironmentJob& job() { return job_; }
    std::optional<EnvironmentShare> shareAtEnd() const { return shareAtEnd_; } ///< at the latest result

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    int results_ = 0, taken_ = 0;
    std::optional<EnvironmentShare> shareAtEnd_;
    EnvironmentJob job_{[this] {
        const std::optional<EnvironmentShare> share = job_.share();
        const std::lock_guard lock(mutex_);
        shareAtEnd_ = share;
        ++results_;
        changed_.notify_all();
    }};
};

TEST_F(EnvironmentJobTest, loadsAndFiltersInTheBackground) {
    const ChosenEnvironment studio = chosen("studio");
    EXPECT_EQ(studio.error, "");
    ASSERT_TRUE(studio.environment);
    EXPECT_EQ(studio.environment->source, "builtin:studio");
    ASSERT_TRUE(studio.filtered);
    EXPECT_EQ(studio.filtered->levels.size(), std::size_t(ENVIRONMENT_LEVELS));
    EXPECT_FALSE(chosen("none").environment);
    const ChosenEnvironment unknown = chosen("stduio");
    EXPECT_FALSE(unknown.environment);
    EXPECT_NE(unknown.error.find("'studio'"), std::string::npos) << unknown.error;
}

TEST_F(EnvironmentJobTest, itReportsHowFarTheChoiceAloneIs) {
    const EmptyCache cache;
    EXPECT_FALSE(job().share());
    chosen("studio");
    ASSERT_TRUE(shareAtEnd());
    EXPECT_TRUE(shareAtEnd()->isFiltering);
    EXPECT_GT(shareAtEnd()->done, 0.9);
    EXPECT_FALSE(job().share()) << "it was taken";
    chosen("studio");
    EXPECT_EQ(shareAtEnd(), (EnvironmentShare{false, 1.0})) << "its map was computed, and what it filters to was kept";
    chosen("none");
    EXPECT_FALSE(shareAtEnd()) << "there is nothing to filter";
}

TEST(EnvironmentProgress, isTheMostThatWasReportedAndFilteringComesAfterComputing) {
    EnvironmentProgress progress;
    EXPECT_FALSE(progress.latest());
    progress.report({false, 0.5});
    progress.report({false, 0.25}); // from another thread
    EXPECT_EQ(progress.latest(), (EnvironmentShare{false, 0.5}));
    progress.report({false, 1.0});
    progress.report({true, 0.0});
    EXPECT_EQ(progress.latest(), (EnvironmentShare{true, 0.0}));
    progress.report({false, 1.0});
    progress.report({true, 0.5});
    EXPECT_EQ(progress.latest(), (EnvironmentShare{true, 0.5}));
    progress.begin();
    EXPECT_FALSE(progress.latest());
}

TEST_F(EnvironmentJobTest, ofChoicesInARowTheLastIsTaken) {
    job().start("studio");
    job().start("sky");
    EXPECT_EQ(chosen("none").name, "none");
    // A discarded job has no result, although its name is chosen again.
    job().start("studio");
    job().discard();
    EXPECT_EQ(job().choice(), "");
    EXPECT_EQ(chosen("studio").environment.value().source, "builtin:studio");
}

TEST_F(EnvironmentJobTest, whatIsSupersededIsNotFilteredToItsEnd) {
    const EmptyCache cache;
    for (const bool isChosen : {true, false}) {
        std::optional<EnvironmentJob> job(std::in_place, [] {});
        job->start("studio");
        const auto isFiltering = [&] { return job->share().value_or(EnvironmentShare()).isFiltering; };
        for (int i = 0; i < 60'000 && !isFiltering(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        ASSERT_TRUE(isFiltering()) << "after a minute";
        if (isChosen) {
            job->start("none");
            for (int i = 0; i < 6000 && !job->hasResult(); ++i)
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
            EXPECT_EQ(job->take().value().name, "none");
        } else {
            job.reset(); // as when the window is closed
        }
        EXPECT_TRUE(cache.isEmpty()) << "what was filtered to its end is kept";
    }
}

TEST_F(EnvironmentJobTest, whatWasChosenIsAnEdit) {
    const scenes::LoadOptions load;
    scenes::Scene room = scenes::loadScene("room", load);
    room.warnings = {"of the file"};
    room.supplied.light = true;
    OpenScene open("room", load, std::move(room), scenes::SceneOrigin());
    open.takeEnvironment(chosen("studio"));
    EXPECT_TRUE(open.isEdited());
    EXPECT_EQ(open.environmentRevision(), 1u);
    EXPECT_EQ(open.scene().environment.value().source, "builtin:studio");
    EXPECT_TRUE(open.filteredEnvironment());
    EXPECT_EQ(open.scene().warnings, std::vector<std::string>{"of the file"});
    EXPECT_FALSE(open.scene().supplied.light) << "another was chosen";
    open.undo();
    EXPECT_TRUE(open.scene().supplied.light);
    open.redo();
    open.takeEnvironment(chosen("none"));
    EXPECT_FALSE(open.scene().environment);
    EXPECT_FALSE(open.filteredEnvironment());
}

TEST_F(EnvironmentJobTest, aSuppliedStudioChosenAgainStandsAroundTheCameraAsBefore) {
    const tessera::test::TempFolder folder; // a flat model is viewed face-on, so the studio is rotated
    const std::string file = folder.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
    OpenScene open(file, {}, scenes::loadScene(file), scenes::SceneOrigin());
    const float supplied = open.scene().environment.value().rotationDegrees;
    EXPECT_NEAR(supplied, -45.0f, 1e-4f); // rounding of an angle in single precision
    open.takeEnvironment(chosen("sky"));
    EXPECT_EQ(open.scene().environment.value().rotationDegrees, 0.0f) << "it was supplied, and is no scene's own";
    open.takeEnvironment(chosen("studio"));
    EXPECT_EQ(open.scene().environment.value().rotationDegrees, supplied);
    scenes::LoadOptions load;
    load.environment = "studio";
    EXPECT_EQ(scenes::loadScene(file, load).environment.value().rotationDegrees, supplied) << "on the command line too";
    load.environment = "none";
    OpenScene dark(file, load, scenes::loadScene(file, load), scenes::SceneOrigin());
    dark.takeEnvironment(chosen("studio"));
    EXPECT_EQ(dark.scene().environment.value().rotationDegrees, supplied);
}

} // namespace
} // namespace tessera::viewer
