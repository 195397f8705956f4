// The cache file of a filtered environment.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string>
#include <utility>

#include <sys/stat.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "renderer/frame/ComputedCache.h"
#include "renderer/frame/EnvironmentFilter.h"
#include "tests/support/TempFolder.h"
#include "tests/unit/frame/GreyMap.h"

namespace tessera::frame {
namespace {

using test::greyMap;

TEST(EnvironmentCache, whatWasFilteredOnceIsReadAgainUnlessItsFileIsDamaged) {
    test::TempFolder folder;
    const scenes::Image map = greyMap(32, 16, [](int x, int y) { return x + 0.1 * y; });
    const FilteredEnvironment fresh = cachedEnvironment(map, folder.path());
    const auto file = *std::filesystem::directory_iterator(folder.path());
    bool computed = false;
    const auto note = [&](double) { computed = true; };
    const FilteredEnvironment again = cachedEnvironment(map, folder.path(), note);
    EXPECT_FALSE(computed);
    ASSERT_EQ(again.levels.size(), fresh.levels.size());
    for (std::size_t i = 0; i < fresh.levels.size(); ++i) EXPECT_EQ(again.levels[i].corners, fresh.levels[i].corners);
    EXPECT_EQ(again.irradiance.corners, fresh.irradiance.corners);
    std::filesystem::resize_file(file.path(), 1000);
    EXPECT_EQ(cachedEnvironment(map, folder.path(), note).irradiance.corners, fresh.irradiance.corners);
    EXPECT_TRUE(computed);
    // A single flipped bit invalidates the file, in the middle or in the last number.
    const auto size = std::streamoff(std::filesystem::file_size(file.path()));
    for (const std::streamoff at : {size / 2, size - 1}) {
        computed = false;
        std::fstream bytes(file.path(), std::ios::in | std::ios::out | std::ios::binary);
        bytes.seekg(at);
        const int byte = bytes.get();
        bytes.seekp(at).put(char(byte ^ 1));
        bytes.close();
        EXPECT_EQ(cachedEnvironment(map, folder.path(), note).irradiance.corners, fresh.irradiance.corners);
        EXPECT_TRUE(computed) << at;
    }
    // Another map of the same size uses another file, and so do the same texels at another size.
    scenes::Image upright = map;
    std::swap(upright.width, upright.height);
    for (const scenes::Image& other : {greyMap(32, 16, [](int x, int) { return x; }), upright}) {
        computed = false;
        cachedEnvironment(other, folder.path(), note);
        EXPECT_TRUE(computed);
    }
}

/// The 64-bit hash of version 10's cache key, over the first words of a map's texels. Each step is invertible.
std::uint64_t wordHash(const scenes::Image& map, std::size_t words) {
    std::uint64_t value = 0x9e3779b97f4a7c15u ^ 10u;
    const auto add = [&](std::uint64_t word) {
        value = (value ^ word) * 0xff51afd7ed558ccdu;
        value ^= value >> 32;
    };
    add(std::uint64_t(map.width));
    add(std::uint64_t(map.height));
    for (std::size_t i = 0; i < words; ++i) {
        std::uint64_t word = 0;
        std::memcpy(&word, map.texels.data() + 8 * i, 8);
        add(word);
    }
    return value;
}

TEST(EnvironmentCache, theTableOfLobesIsWrittenOnceAndReadAgain) {
    test::TempFolder folder;
    const std::vector<glm::vec4> fresh = cachedLobeTable(folder.path());
    const std::filesystem::path file = *std::filesystem::directory_iterator(folder.path());
    std::filesystem::create_hard_link(file, folder.path() / "same");
    EXPECT_EQ(cachedLobeTable(folder.path()), fresh);
    EXPECT_EQ(std::filesystem::hard_link_count(file), 2u) << "the file was replaced";
}
TEST(EnvironmentCache, aMapThatIsMadeForTheKeyOfAnotherIsNotReadInItsPlace) {
    test::TempFolder folder;
    const scenes::Image map = greyMap(32, 16, [](int x, int y) { return 1.0 + x + 0.1 * y; });
    scenes::Image crafted = greyMap(32, 16, [](int x, int y) { return 9.0 + x + 0.1 * y; });
    const std::size_t words = map.texels.size() / 8;
    ASSERT_EQ(8 * words, map.texels.size());
    // The states before the last word are known, so the colliding last word follows: (state ^ word) must be equal.
    std::uint64_t last = 0;
    std::memcpy(&last, map.texels.data() + 8 * (words - 1), 8);
    last ^= wordHash(map, words - 1) ^ wordHash(crafted, words - 1);
    std::memcpy(crafted.texels.data() + 8 * (words - 1), &last, 8);
    ASSERT_EQ(wordHash(map, words), wordHash(crafted, words));
    const auto onlyFileIn = [&](const char* name) {
        return std::filesystem::directory_iterator(folder.path() / name)->path();
    };
    std::filesystem::create_directory(folder.path() / "b");
    cachedEnvironment(crafted, folder.path() / "a");
    std::filesystem::copy_file(onlyFileIn("a"), folder.path() / "b" / onlyFileIn("a").filename());
    bool computed = false;
    const auto note = [&](double) { computed = true; };
    const FilteredEnvironment fresh = cachedEnvironment(map, folder.path() / "a", note);
    EXPECT_TRUE(std::exchange(computed, false));
    // Nor is a file with the right name but another map's content used.
    const std::filesystem::path wrong = onlyFileIn("b");
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "a")) {
        EXPECT_EQ(entry.path().stem().string().size(), std::string("environment-").size() + 64);
        std::filesystem::copy_file(wrong, entry.path(), std::filesystem::copy_options::overwrite_existing);
    }
    EXPECT_EQ(cachedEnvironment(map, folder.path() / "a", note).irradiance.corners, fresh.irradiance.corners);
    EXPECT_TRUE(computed);
}

TEST(EnvironmentCache, whatIsNoFileInItsPlaceIsReplacedAndNeitherFollowedNorWaitedFor) {
    test::TempFolder folder;
    const scenes::Image map = greyMap(32, 16, [](int x, int y) { return x + 0.1 * y; });
    const FilteredEnvironment fresh = cachedEnvironment(map, folder.path() / "cache");
    const std::filesystem::path file = std::filesystem::directory_iterator(folder.path() / "cache")->path();
    const std::filesystem::path own = folder.path() / "precious";
    std::ofstream(own) << "mine";
    std::filesystem::remove(file);
    std::filesystem::create_symlink(own, file);
    EXPECT_EQ(cachedEnvironment(map, folder.path() / "cache").irradiance.corners, fresh.irradiance.corners);
    EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(file)));
    EXPECT_EQ(std::filesystem::file_size(own), 4u);
    std::filesystem::remove(file);
    ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
    EXPECT_EQ(cachedEnvironment(map, folder.path() / "cache").irradiance.corners, fresh.irradiance.corners);
    EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(file)));
}

TEST(EnvironmentCache, ofManyFilesThoseUsedLastAreKeptAndNoFileOfOthersIsRemoved) {
    test::TempFolder folder;
    std::ofstream(folder.path() / "notes.bin") << "mine";
    const auto fileOf = [&](int number) { return folder.path() / fmt::format("environment-{}.bin", number); };
    const auto start = std::filesystem::file_time_type::clock::now() - std::chrono::hours(100);
    for (int number = 0; number < 40; ++number) {
        std::ofstream(fileOf(number)) << "old";
        std::filesystem::last_write_time(fileOf(number), start + std::chrono::hours((number + 20) % 40));
    }
    cachedEnvironment(greyMap(8, 4, [](int x, int) { return x; }), folder.path());
    const auto files = std::filesystem::directory_iterator(folder.path());
    EXPECT_EQ(std::distance(begin(files), end(files)), 32 + 1);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "notes.bin"));
    for (int number = 0; number < 40; ++number)
        EXPECT_EQ(std::filesystem::exists(fileOf(number)), number < 20 || number >= 29) << number;
}

/// A map of a common size.
TEST(EnvironmentCacheSlow, aMapOf2048ColumnsTakesFiveSecondsOfTwoCoresAndReadAgainATwentiethOfASecond) {
#ifdef __SANITIZE_ADDRESS__
    constexpr double kSlower = 20.0; // sanitizers take several times as long
#else
    constexpr double kSlower = 1.0;
#endif
    constexpr double kCores = 2.0, kMostSeconds = 5.0, kMostSecondsAgain = 0.05;
    test::TempFolder folder;
    const scenes::Image map =
        greyMap(2048, 1024, [](int x, int y) { return 1.0 + std::sin(0.01 * x) * std::cos(0.03 * y); });
    const std::clock_t start = std::clock(); // CPU time of all threads: other programs do not count
    const FilteredEnvironment fresh = cachedEnvironment(map, folder.path());
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC / kCores;
    double secondsAgain = kMostSeconds;
    for (int round = 0; round < 5; ++round) {
        const auto began = std::chrono::steady_clock::now();
        EXPECT_EQ(cachedEnvironment(map, folder.path()).irradiance.corners, fresh.irradiance.corners);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
        secondsAgain = std::min(secondsAgain, took.count());
    }
    fmt::print("filtered in {:.2f} s, read again in {:.1f} ms\n", seconds, 1e3 * secondsAgain);
    EXPECT_LE(seconds, kSlower * kMostSeconds);
    EXPECT_LE(secondsAgain, kSlower * kMostSecondsAgain);
}

TEST(EnvironmentCache, aFolderThatCannotBeWrittenIsReportedOnce) {
    takeCacheFault(); // clears faults of other tests
    test::TempFolder folder;
    const std::filesystem::path file = folder.path() / "file";
    std::ofstream(file) << "in the way";
    const scenes::Image map = greyMap(32, 16, [](int x, int) { return 2.0 + x; });
    const FilteredEnvironment fresh = filterEnvironment(map);
    EXPECT_EQ(cachedEnvironment(map, file / "cache").irradiance.corners, fresh.irradiance.corners);
    const std::string fault = takeCacheFault();
    EXPECT_NE(fault.find((file / "cache").string()), std::string::npos) << fault;
    EXPECT_NE(fault.find("Not a directory"), std::string::npos) << fault;
    EXPECT_EQ(takeCacheFault(), "");
    cachedEnvironment(map, file / "cache");
    EXPECT_EQ(takeCacheFault(), "") << "it was said";
}

} // namespace
} // namespace tessera::frame
