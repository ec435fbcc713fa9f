#include "wilt/import/photo_leaf.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "wilt/core/error.hpp"
#include "wilt/import/drawn_leaf.hpp"
#include "wilt/import/photo_cover.hpp"
#include "wilt/import/photo_file.hpp"
#include "wilt/import/photo_objects.hpp"
#include "wilt/import/photo_outline.hpp"
#include "wilt/import/photo_petiole.hpp"
#include "wilt/import/photo_texture.hpp"
#include "wilt/leaf/petiole.hpp"

namespace wilt::detail {
namespace {

Cover cover_of(const Photo& photo, const ReadOptions& options) {
  if (!options.mask.empty()) return cover_of_alpha(read_mask(options.mask, photo));
  if (!photo.alpha.empty() && !options.threshold) return cover_of_alpha(photo.alpha);
  return cover_of_colours(photo.rgb, options.threshold);
}

// How the leaf was told from what is around it.
std::string separation_note(const Cover& cover, const ReadOptions& options) {
  if (!options.mask.empty()) return "the leaf is where --mask is white";
  if (cover.threshold == 0.0) return "the leaf is where the alpha channel is opaque";
  return fmt::format(
      "the leaf differs from its plain background by {:.0f} in colour (CIE Lab); if it is cut "
      "out badly give --threshold or --mask",
      cover.threshold);
}

std::string listed(const std::vector<PhotoObject>& objects) {
  std::vector<std::string> reasons;
  for (const PhotoObject& object : objects)
    if (!object.no_leaf_reason.empty()) reasons.push_back(object.no_leaf_reason);
  std::sort(reasons.begin(), reasons.end());
  reasons.erase(std::unique(reasons.begin(), reasons.end()), reasons.end());
  return fmt::format("{}", fmt::join(reasons, ", "));
}

int count_of(const std::vector<PhotoObject>& objects) {
  const auto leaves = std::count_if(objects.begin(), objects.end(),
                                    [](const PhotoObject& object) { return object.no_leaf_reason.empty(); });
  return static_cast<int>(leaves > 0 ? leaves : static_cast<std::ptrdiff_t>(objects.size()));
}

// The leaf that was asked for, with what a user should know of the choice.
PhotoObject chosen(std::vector<PhotoObject> objects, int nth, std::vector<std::string>& notes) {
  if (objects.empty())
    throw Error(ErrorCode::input,
                "nothing in the photo stands out from its background; put the leaf on a "
                "background of another colour, or pass --threshold or --mask mask.png");
  const bool only_others = !objects.front().no_leaf_reason.empty();
  const int leaves = count_of(objects);
  if (nth > leaves)
    throw Error(ErrorCode::input,
                fmt::format("--leaf {}: the photo shows {} that may be a leaf", nth, leaves));
  PhotoObject object = std::move(objects[static_cast<std::size_t>(nth - 1)]);
  if (only_others) {
    notes.push_back(fmt::format("what was taken for the leaf has the shape of {}", object.no_leaf_reason));
  } else if (leaves > 1) {
    notes.push_back(
        fmt::format("the photo shows {} things that may be leaves; this is number {} (--leaf N "
                    "takes the N-th largest, --leaf all each)",
                    leaves, nth));
  }
  if (const std::string others = listed(objects); !only_others && !others.empty())
    notes.push_back("left out: " + others);
  if (object.cut_off)
    notes.push_back("the leaf touches the edge of the photo: what lies beyond it is missing");
  return object;
}

Vec2 pixel_of(const cv::Point2d& p, double scale) {
  return {scale * p.x, -scale * p.y};
}

cv::Point2d point_of(const Vec2& outline_point, double scale) {
  return {outline_point.x() / scale, -outline_point.y() / scale};
}

// Where the stalk meets the blade. A stalk in the outline tells; else the place where main veins meet, with
// the sinus opened to it if basal lobes overlap; else (nothing) the outline's shape.
void locate_petiole(const Photo& photo, const ReadOptions& options, PhotoObject& object, DrawnLeaf& drawn) {
  const double scale = photo.scale;
  std::optional<cv::Point2d> petiole;
  if (options.petiole) {
    petiole = cv::Point2d(options.petiole->x() / scale, options.petiole->y() / scale);
  } else if (!cut_stalk(drawn.outline).found) {
    if (const auto fork = find_vein_fork(photo.rgb, object)) {
      petiole = fork->place;
      drawn.petiole_reason = fmt::format("where {} main veins meet", fork->angles.size());
    }
  }
  if (!petiole) return;
  const PetioleGuess guess = find_petiole(drawn.outline.margin);
  const cv::Point2d notch = point_of(drawn.outline.margin.row(guess.index).transpose(), scale);
  const double cut = open_sinus(object, *petiole, notch);
  if (cut > 0.0) {
    drawn.outline = trace_outline(object, scale);
    drawn.notes.push_back(
        fmt::format("the lobes beside the petiole overlap or touch: the blade was cut open "
                    "there, over {:.0f} pixels",
                    scale * cut));
  }
  drawn.petiole = pixel_of(*petiole, scale);
}

}  // namespace

int count_photo_leaves(std::string_view bytes, const ReadOptions& options) {
  const Photo photo = parse_photo(bytes);
  return count_of(photo_objects(cover_of(photo, options).share));
}

Leaf leaf_from_photo(std::string_view bytes, const std::string& name, const ReadOptions& options,
                     const Monitor& monitor) {
  monitor.report("photo", 0.0);
  const Photo photo = parse_photo(bytes);
  const Cover cover = cover_of(photo, options);
  monitor.report("photo", 0.4);
  DrawnLeaf drawn;
  drawn.y_down = true;
  drawn.notes.push_back(separation_note(cover, options));
  PhotoObject object = chosen(photo_objects(cover.share), options.nth, drawn.notes);
  drawn.outline = trace_outline(object, photo.scale);
  monitor.report("photo", 0.6);
  locate_petiole(photo, options, object, drawn);
  drawn.photo = leaf_photo(photo, object);
  monitor.report("photo", 1.0);
  return leaf_from_outline(std::move(drawn), name, options, monitor);
}

}  // namespace wilt::detail
