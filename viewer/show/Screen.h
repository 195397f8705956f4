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
#include "viewer/show/DiffusedLight.h"
#include "viewer/show/DrawnPicture.h"
#include "viewer/show/ResolutionScale.h"
#include "viewer/show/Smoothing.h"

namespace tessera::viewer {

/// Draws the open scene, and shows the latest good images in the window.
class Screen {
public:
    /// The images to be shown.
    struct Wanted {
        std::array<Look, 2> looks; ///< with the size in the window
        int sides = 1;
        bool keepsRadiance = false; ///< to compare, to inspect or to count
        std::uint64_t sceneRevision = 0;
        std::uint64_t sceneEdits = 0; ///< OpenScene::pictureEdits()
        bool operator==(const Wanted&) const = default;
    };
    /// Whether a better image follows: when everything is idle, at once (this one is a step), or not at all.
    enum class Stay : std::uint8_t { Passes, Refines, Stays };
    /// The result of draw().
    struct Drawn {
        bool gaveUp = false;
        std::array<bool, 2> isOfSide{}; ///< the side was drawn; else its image was current
        bool lacksLight = false;        ///< irradiance is still to be diffused, so that another image follows
        bool isUnlike = false; ///< compiled shaders or recomputed diffused irradiance: later images take less time
        double scale = 1.0;
        glm::ivec2 sizePixels{0};
        double ms = 0.0;                                    ///< of all sides, including the wait for the GPU
        std::array<std::vector<gpu::PassTiming>, 2> passes; ///< by side
        std::array<double, 2> sideMs{};
        std::array<std::optional<engine::DrawnShadows>, 2> shadows;
        // From engine::Renderer, for the last side drawn.
        std::string missingTextures;
        std::optional<std::string> invisibleDiffusion; ///< none if small atlases were used
    };

    explicit Screen(gpu::Context& context);

    /// Draws this scene from now on, which must outlive its use here; the images of the previous one stay until then.
    /// Throws as the Renderer's constructor does; then the previous scene stays.
    void open(const OpenScene& scene);
    /// Passes edits of geometry, materials and the environment to the renderer.
    void takeEdits();
    engine::Renderer* renderer() const { return renderer_.get(); }

    /// The scale of the drawn images if they are the wanted ones, else 0. Images that failed count as complete: a retry
    /// would fail again.
    double scaleOf(const Wanted& wanted) const;
    /// The same, even if the images lack diffused irradiance.
    double shownScale(const Wanted& wanted) const;
    /// Whether the wanted images are displayed.
    bool shows(const Wanted& wanted) const { return failed_ != wanted && shownScale(wanted) > 0.0; }
    /// The scale of images to draw at once while something moves.
    double movingScale() const { return resolution_.next(); }
    /// Predicted time of the images at one of kScales, from previous ones.
    double predictedMs(double scale) const { return resolution_.predictedMs(scale); }
    /// The side that draw() is drawing; for its `givesUp`.
    int drawingSide() const { return drawingSide_; }
    /// Whether draw() draws that side at all.
    bool isDrawing(int side) const { return isOfSide_[std::size_t(side)]; }
    /// Whether programs must be compiled for the wanted images.
    bool lacksPrograms(const Wanted& wanted) const;
    /// Whether programs are missing, or the images are of another kind than the latest ones: no previous time predicts
    /// theirs.
    bool isNewKind(const Wanted& wanted) const;
    /// Whether diffused irradiance must be recomputed, which takes seconds at full resolution.
    bool diffusesAnew(const Wanted& wanted) const;
    /// Whether irradiance must be diffused in slices: of visible surfaces before an image that stays (Seen), or of all
    /// surfaces after it, for other cameras (All).
    enum class Reach : std::uint8_t { Seen, All };
    bool lacksLight(const Wanted& wanted, Reach reach) const;
    /// Diffuses a slice; the images stay unchanged. Throws as Renderer::draw does; then the image counts as failed.
    engine::DiffusionProgress diffuseSlice(const Wanted& wanted, Reach reach);
    /// Whether drawing may take so long that pending input must abort it: the image is the first of its kind, or even
    /// the latest one drawn while something moved took that long.
    bool isSlow(const Wanted& wanted) const { return isNewKind(wanted) || latestMs_ > kSlowMs; }
    /// Whether the wanted images have kept their light lists, if their views have any; draw() keeps them on request.
    bool hasLights(const Wanted& wanted) const;
    /// Draws the wanted images at a scale, except for a side that already has its image at that scale. Images that do
    /// not stay use small atlases if irradiance must be recomputed, and on software rasterisers do not diffuse newly
    /// visible surfaces. `givesUp` may be null, and may show the previous images, which stay if it aborts the frame, or
    /// the frame fails. Throws as Renderer::draw does.
    Drawn draw(const Wanted& wanted, double scale, Stay stay, bool keepsLights, const std::function<bool()>& givesUp);
    /// Whether the single full-resolution image lacks some of the shifted ones that antialias it (Smoothing.h).
    bool lacksSmoothing(const Wanted& wanted) const;
    /// Draws the next of them; if `givesUp` aborts it, returns false without effect. Throws as draw() does; then the
    /// image stays unchanged.
    bool smooth(const Wanted& wanted, const std::function<bool()>& givesUp);
    void forgetSmoothing() { smoothed_.reset(); }
    /// Whether show() shows the mean of shifted images instead of the image.
    bool showsSmoothed() const { return smoothed_ && shows(*smoothed_) && smoothing_.shown() != nullptr; }
    bool isSmoothed() const { return showsSmoothed() && smoothing_.isDone(); }

    /// Redraws the current images after a change of shaders, and diffuses their irradiance again.
    void forget() {
        made_ = {};
        failed_.reset();
        differenceIsStale_ = true;
        forgetSmoothing();
        forgetDiffusedLight();
    }

    /// Computes the difference image, amplified by `factor`, if the images or the factor have changed. Throws
    /// gpu::ShaderError.
    void prepareDifference(float factor);
    /// Recolours each image of counts with a scale that ends at the given power of two. Throws gpu::ShaderError.
    void colorCounts(const std::function<float(int side, frame::DebugView view)>& scaleLog2);
    /// Shows the images in a part of the window, whose framebuffer stays bound; the rest of it is cleared. Magnified
    /// pixels are squares.
    void show(glm::ivec2 windowPixels, const gpu::Rectangle& area, Compare compare, float divider,
              const Magnification& magnification);
    /// Shows pixels of a side's image enlarged, about a position, in a square of the window, in the framebuffer bound
    /// by show(). A square that is no multiple of kLoupeTexels is filled with whole pixels only.
    void magnify(int side, const glm::vec2& place, const gpu::Rectangle& square);
    const gpu::Capabilities& capabilities() const { return context_.capabilities(); }
    /// The look of a side's displayed image; none without one.
    std::optional<Look> shownLook(int side) const {
        const DrawnPicture& shown = picture(side);
        return shown.isThere() ? std::optional(shown.look()) : std::nullopt;
    }
    /// Of the left image, before exposure; 0 if it does not show light. Waits for the GPU.
    double meanLuminance() const;
    const DrawnPicture& picture(int side) const { return pictures_[std::size_t(side)]; }

private:
    /// How the image of a side was made.
    struct Made {
        Look look;
        std::uint64_t sceneRevision = 0, sceneEdits = 0;
        double scale = 0.0;
        bool lacksLight = false;
    };
    /// The same, if it is the wanted image; else null.
    const Made* madeFor(const Wanted& wanted, int side) const;
    bool hasLights(int side) const {
        return picture(side).lights() != nullptr || !PictureLights::areCounted(picture(side).look());
    }
    /// Whether both images exist, of one size and one scene.
    bool canDiffer() const;
    void recordDiffusedLight(const Wanted& drawn);
    void forgetDiffusedLight();
    /// The program keys of all sides.
    const std::set<std::string>& programsOf(const Wanted& wanted) const;

    static constexpr double kSlowMs = 250.0;

    gpu::Context& context_;
    const OpenScene* scene_ = nullptr;
    std::unique_ptr<engine::Renderer> renderer_;
    std::uint64_t geometryRevision_ = 0, materialRevision_ = 0, environmentRevision_ = 0;
    std::array<DrawnPicture, 2> pictures_;
    DrawnPicture waiting_; ///< the left image, while the right one is drawn too
    int drawingSide_ = 0;
    std::array<bool, 2> isOfSide_{}; ///< Drawn::isOfSide of the latest draw()
    CountColors countColors_;
    Difference difference_;
    bool differenceIsStale_ = true;
    float differenceFactor_ = 0.0f;
    ResolutionScale resolution_;
    DiffusedLight diffusedLight_;       ///< of this scene
    DiffusionPace pace_;                ///< likewise
    std::optional<Wanted> diffusedFor_; ///< the visible surfaces of these images have their irradiance
    bool isAllDiffused_ = false;        ///< irradiance is diffused for all cameras,
    bool isAllTooMuch_ = false;         ///< or would take too much memory
    /// Programs of the wanted images.
    struct Programs {
        Wanted wanted;
        std::set<std::string> keys;
    };
    mutable std::optional<Programs> programs_; ///< latest result of programsOf(), for this scene
    std::set<std::string> known_;              ///< programs of the images drawn for this scene
    std::optional<std::array<Look, 2>> kind_;  ///< of the images drawn last for this scene
    std::array<std::optional<Made>, 2> made_;
    std::array<std::uint64_t, 2> shownScene_{}; ///< by side: Wanted::sceneRevision of its image
    bool isOfOneScene() const { return pictures_[1].isThere() && shownScene_[0] == shownScene_[1]; }
    std::optional<Wanted> failed_;
    Smoothing smoothing_;
    std::optional<Wanted> smoothed_; ///< the images that it antialiases
    bool isSmoothingAtFault_ = false;
    double latestMs_ = 0.0; ///< of the latest image while something moved, without compiling shaders
};

} // namespace tessera::viewer
