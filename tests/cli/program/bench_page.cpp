// The report of a benchmark in a real browser.
#include <regex>

#include "tests/cli/program/Cli.h"

namespace tessera::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Writes facts that only a browser has into the page's title: painted pixels of each plot, the number of sliders,
/// and the page's pixels beyond the window's width.
constexpr const char* kProbe = R"(<script>
addEventListener("load", () => {
    const painted = (id) => {
        const canvas = document.getElementById(id);
        const bytes = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
        let count = 0;
        for (let i = 3; i < bytes.length; i += 4) count += bytes[i] > 0;
        return count;
    };
    const root = document.documentElement;
    document.title = ["probe", painted("front-plot"), painted("scaling-plot"),
        document.querySelectorAll(".viewer .stage").length, Math.max(0, root.scrollWidth - innerWidth)].join(" ");
    const scaling = Chart.getChart("scaling-plot");
    root.dataset.ticks = scaling.scales.x.ticks.map((tick) => tick.label).join(" ");
    const names = [...document.querySelectorAll("#scaling .legend .curve")];
    const last = names[names.length - 1].getBoundingClientRect();
    names[0].click();
    root.dataset.legend = [names.length, last.bottom <= document.getElementById("points").getBoundingClientRect().top,
        names[0].getAttribute("aria-pressed"), scaling.isDatasetVisible(0), scaling.isDatasetVisible(1)].join(" ");
    root.dataset.curves = scaling.data.datasets.map((set) => set.label).join("; ");
});
</script>)";

class BenchPage : public Cli {
protected:
    void SetUp() override {
        if (runShell("command -v chromium", folder_.path()).exitCode != 0) GTEST_SKIP() << "chromium is not installed";
    }

    /// Loads a page and returns its DOM; messages of the console are on stderr.
    ProcessResult browse(const std::string& file, const std::string& size) const {
        return runShell("exec chromium --headless=new --no-sandbox --disable-gpu --user-data-dir=profile "
                        "--enable-logging=stderr --window-size=" +
                            size + " --dump-dom 'file://" + path(file) + "'",
                        folder_.path());
    }

    static std::string group(const std::string& text, const std::string& pattern, std::size_t index = 1) {
        std::smatch match;
        return std::regex_search(text, match, std::regex(pattern)) ? match[index].str() : "";
    }
};

TEST_F(BenchPage, everyPlotShowsItsPointsInABrowserWithoutAComplaint) {
    folder_.write("m.json", R"({"technique": ["forward", "deferred"], "layout": ["exact", "packed"],
                                "lights": [4, 17, 1025]})");
    runGood({"bench", "lattice", "--size", "64x36", "--frames", "2", "--matrix", "m.json", "-o", "out"});
    std::string page = text("out/report.html");
    page.insert(page.rfind("</body>"), kProbe);
    folder_.write("probe.html", page);
    for (const char* size : {"1280,800", "500,844"}) { // a desktop; the narrowest window that chromium opens
        SCOPED_TRACE(size);
        const ProcessResult seen = browse("probe.html", size);
        ASSERT_EQ(seen.exitCode, 0) << seen.err;
        EXPECT_THAT(seen.err, Not(HasSubstr("CONSOLE")));
        EXPECT_EQ(group(seen.out, "id=\"front-plot\"[^>]*data-points=\"([0-9]+)\""), "3");
        EXPECT_EQ(group(seen.out, "id=\"scaling-plot\"[^>]*data-points=\"([0-9]+)\""), "9");
        const std::string probe = "<title>probe ([0-9]+) ([0-9]+) ([0-9]+) ([0-9]+)</title>";
        ASSERT_NE(group(seen.out, probe), "") << "the probe did not run";
        // Axes, marks and names: far more than an empty frame.
        EXPECT_GT(std::stoi(group(seen.out, probe, 1)), 3000);
        EXPECT_GT(std::stoi(group(seen.out, probe, 2)), 3000);
        EXPECT_EQ(group(seen.out, probe, 3), "1") << "sliders";
        EXPECT_EQ(group(seen.out, probe, 4), "0") << "pixels beyond the window";
        EXPECT_EQ(group(seen.out, "data-ticks=\"([^\"]*)\""), "4 17 1,025");
        // The legend names every curve, below the plot and above the next section; a click hides its curve.
        EXPECT_EQ(group(seen.out, "data-legend=\"([^\"]*)\""), "3 true false false true");
        const std::string slope = "exact \\((no trend|-?[0-9]\\.[0-9]{2})\\)";
        EXPECT_NE(group(seen.out, "data-curves=\"(forward, " + slope + "; deferred, " + slope + ")"), "");
    }
}

TEST_F(BenchPage, theBrowserOfThisTestReportsABrokenScript) {
    folder_.write("broken.html", "<!DOCTYPE html><title>x</title><script>nothing.at.all()</script>");
    EXPECT_THAT(browse("broken.html", "800,600").err, HasSubstr("CONSOLE"));
}

} // namespace
} // namespace tessera::test
