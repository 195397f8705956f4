#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "renderer/gpu/Commands.h"
#include "viewer/session/State.h"
#include "viewer/show/CountColors.h"
#include "viewer/show/Difference.h"
#include "viewer/show/DrawnPicture.h"
#include "viewer/show/ResolutionScale.h"
#include "viewer/show/Smoothing.h"
#include "viewer/show/SpreadLight.h"

namespace tessera::viewer {

/// Draws the open scene and shows the latest good pictures in the window.
class Screen {
public:
    /// What should be seen.
    struct Wanted {
        std::array<Look, 2> looks; ///< of the size they are to be shown at
        int sides = 1;
        bool keepsRadiance = false; ///< to compare, to inspect or to count
        std::uint64_t sceneRevision = 0;
        std::uint64_t sceneEdits = 0; ///< of lights and materials
        bool operator==(const Wanted&) const = default;
    };
    /// Whether a better picture follows: once all is at rest; at once, of which this is a step; or none.
    enum class Stay : std::uint8_t { Passes, Refines, Stays };
    /// What a call of draw() did.
    struct Drawn {
        bool gaveUp = false;
        std::array<bool, 2> isOfSide{}; ///< it drew that side; the other one had its picture
        bool lacksLight = false;        ///< that is to be spread over surfaces, so that another picture follows
        bool isUnlike = false;          ///< it compiled shaders, or spread light anew: pictures like it take less
        double scale = 1.0;
        glm::ivec2 sizePixels{0};
        double ms = 0.0;                                    ///< of all sides, the waiting for the GPU included
        std::array<std::vector<gpu::PassTiming>, 2> passes; ///< by side
        std::array<double, 2> sideMs{};
        std::array<std::optional<engine::DrawnShadows>, 2> shadows;
        // Of engine::Renderer, of the latest side.
        std::string missingTextures;
        std::optional<std::string> unseenSpread; ///< none where small atlases stood in
    };

    explicit Screen(gpu::Context& context);

    /// Draws this scene from now on, which must outlive its use here; the pictures of the one before stay until then.
    /// Throws as the Renderer's constructor does; then the scene before stays.
    void open(const OpenScene& scene);
    /// Hands edits of materials, and another environment, to the renderer.
    void takeEdits();
    engine::Renderer* renderer() const { return renderer_.get(); }

    /// Whether what is wanted is what was drawn, and at which scale: 0 where it was not. What could not be drawn counts
    /// as whole: it would fail again.
    double scaleOf(const Wanted& wanted) const;
    /// The same, whatever light the pictures lack.
    double shownScale(const Wanted& wanted) const;
    /// Whether the pictures are the wanted ones.
    bool shows(const Wanted& wanted) const { return failed_ != wanted && shownScale(wanted) > 0.0; }
    /// A picture that is worth drawing at once while things move.
    double movingScale() const { return resolution_.next(); }
    /// What the pictures would take at one of kScales, as far as those before tell.
    double predictedMs(double scale) const { return resolution_.predictedMs(scale); }
    /// Of the pictures that draw() draws, which one; for its `givesUp`.
    int drawingSide() const { return drawingSide_; }
    /// Whether it draws that side at all.
    bool isDrawing(int side) const { return isOfSide_[std::size_t(side)]; }
    /// Whether programs have to be compiled before what is wanted is drawn.
    bool lacksPrograms(const Wanted& wanted) const;
    /// Whether it lacks some, or is of another kind than what was drawn last: it takes a time that none before tells.
    bool isNewKind(const Wanted& wanted) const;
    /// Whether light that spreads over surfaces is to be computed anew, which a whole picture takes seconds for.
    bool spreadsAnew(const Wanted& wanted) const;
    /// Whether light is to be spread, slice by slice, before a picture that stays is drawn, or for those of other
    /// cameras after it.
    enum class Reach : std::uint8_t { Seen, All };
    bool lacksLight(const Wanted& wanted, Reach reach) const;
    /// Spreads a slice of it; the pictures stay as they are. Throws as Renderer::draw does; then the picture counts as
    /// failed.
    engine::SpreadProgress spreadSlice(const Wanted& wanted, Reach reach);
    /// Whether it may take so long that it must be given up where somebody waits: it is the first of its kind, or even
    /// the latest picture of moving things took that long.
    bool isSlow(const Wanted& wanted) const { return isNewKind(wanted) || latestMs_ > kSlowMs; }
    /// Whether the wanted pictures have kept what they tell of the lights that their pixels visit, which those of
    /// draw() do that are asked to.
    bool knowsLights(const Wanted& wanted) const;
    /// Draws the wanted pictures at a scale, but for a side that has its picture at that scale already. Unless they
    /// stay, they are drawn with small atlases where light must be spread anew, and on a software rasteriser without
    /// spreading the light of what has come into view. `givesUp` may be null, and may show the pictures as they were
    /// before; where it ends the frame, or the frame fails, they stay so. Throws as Renderer::draw does.
    Drawn draw(const Wanted& wanted, double scale, Stay stay, bool keepsLights, const std::function<bool()>& givesUp);
    /// Whether the one picture, which is whole, lacks some of the shifted ones that smooth its edges (Smoothing.h).
    bool lacksSmoothing(const Wanted& wanted) const;
    /// Draws the next of them, unless `givesUp`: then false, and all is as it was. Throws as draw() does; then the
    /// picture stays as it is.
    bool smooth(const Wanted& wanted, const std::function<bool()>& givesUp);
    void forgetSmoothing() { smoothed_.reset(); }
    /// Whether show() shows the mean of shifted pictures in the place of the picture.
    bool showsSmoothed() const { return smoothed_ && shows(*smoothed_) && smoothing_.shown() != nullptr; }
    bool isSmoothed() const { return showsSmoothed() && smoothing_.isDone(); }

    /// Redraws the current pictures after a change of shaders, and spreads their light again.
    void forget() {
        made_ = {};
        failed_.reset();
        differenceIsStale_ = true;
        forgetSmoothing();
        forgetSpreadLight();
    }

    /// Makes the picture of the difference, amplified by `factor`, where the pictures or the factor changed. Throws
    /// gpu::ShaderError.
    void prepareDifference(float factor);
    /// Gives each picture that shows counts the colours of a scale that ends there, as a power of two. Throws
    /// gpu::ShaderError.
    void colorCounts(const std::function<float(int side, frame::DebugView view)>& scaleLog2);
    /// Shows the pictures in a part of the window, whose framebuffer stays bound; the rest of it is cleared. Magnified
    /// pixels are squares.
    void show(glm::ivec2 windowPixels, const gpu::Rectangle& area, Compare compare, float divider,
              const Magnification& magnification);
    /// Shows pixels of a side's picture large, about the one at a place, in a square of the window: what show() left
    /// bound. A square that is no multiple of kLoupeTexels is filled as far as whole pixels go.
    void magnify(int side, const glm::vec2& place, const gpu::Rectangle& square);
    const gpu::Capabilities& capabilities() const { return context_.capabilities(); }
    /// How the picture of a side that the window shows was drawn; none where it shows none.
    std::optional<Look> shownLook(int side) const {
        const DrawnPicture& shown = picture(side);
        return shown.isThere() ? std::optional(shown.look()) : std::nullopt;
    }
    /// Of the left picture, before exposure; 0 where it shows something else than light. Waits for the GPU.
    double meanLuminance() const;
    const DrawnPicture& picture(int side) const { return pictures_[std::size_t(side)]; }

private:
    /// How the picture of a side was made.
    struct Made {
        Look look;
        std::uint64_t sceneRevision = 0, sceneEdits = 0;
        double scale = 0.0;
        bool lacksLight = false;
    };
    /// That, where it is the wanted one.
    const Made* madeFor(const Wanted& wanted, int side) const;
    bool knowsLights(int side) const {
        return picture(side).lights() != nullptr || !PictureLights::areTold(picture(side).look());
    }
    /// Both pictures are there, of one size.
    bool canDiffer() const;
    void tellSpreadLight(const Wanted& drawn);
    void forgetSpreadLight();
    /// By their keys, those of all sides.
    const std::set<std::string>& programsOf(const Wanted& wanted) const;

    static constexpr double kSlowMs = 250.0;

    gpu::Context& context_;
    const OpenScene* scene_ = nullptr;
    std::unique_ptr<engine::Renderer> renderer_;
    std::uint64_t geometryRevision_ = 0, materialRevision_ = 0, environmentRevision_ = 0;
    std::array<DrawnPicture, 2> pictures_;
    DrawnPicture waiting_; ///< the left one, where the right one is to be drawn too
    int drawingSide_ = 0;
    std::array<bool, 2> isOfSide_{}; ///< Drawn::isOfSide, of the latest
    CountColors countColors_;
    Difference difference_;
    bool differenceIsStale_ = true;
    float differenceFactor_ = 0.0f;
    ResolutionScale resolution_;
    SpreadLight spreadLight_;         ///< of this scene
    SpreadPace pace_;                 ///< likewise
    std::optional<Wanted> spreadFor_; ///< its light is there, as far as it is seen
    bool isAllSpread_ = false;        ///< light is there for all cameras,
    bool isAllTooMuch_ = false;       ///< or would take too much memory
    /// Of what is wanted.
    struct Programs {
        Wanted wanted;
        std::set<std::string> keys;
    };
    mutable std::optional<Programs> programs_; ///< as they were asked for last, of this scene
    std::set<std::string> known_;              ///< programs of the pictures that were drawn of this scene
    std::optional<std::array<Look, 2>> kind_;  ///< of the pictures drawn last of this scene
    std::array<std::optional<Made>, 2> made_;
    std::array<std::uint64_t, 2> shownScene_{}; ///< by side: Wanted::sceneRevision of its picture
    bool isOfOneScene() const { return pictures_[1].isThere() && shownScene_[0] == shownScene_[1]; }
    std::optional<Wanted> failed_;
    Smoothing smoothing_;
    std::optional<Wanted> smoothed_; ///< what it is of
    bool isSmoothingAtFault_ = false;
    double latestMs_ = 0.0; ///< of the latest picture while something moved, without what was spent on compiling
};

} // namespace tessera::viewer
