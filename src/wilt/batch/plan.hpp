// A plan: which leaves a batch makes, how their settings vary and what is written of each (docs/batches.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "wilt/render/picture.hpp"
#include "wilt/run/leaf_request.hpp"
#include "wilt/simulation/config.hpp"

namespace wilt {

inline constexpr int kEveryFrame = -1;

/// Pictures of every item of a plan.
struct PicturePlan {
  /// How many: one of the last frame, several evenly over the clip; or kEveryFrame. 0: none.
  int frames = 0;
  int width = 512, height = 512;  ///< pixels
  int samples = 32;               ///< per pixel at most
  std::vector<std::string> maps;  ///< label pictures beside each, by label_name() (label_files.hpp)
};

/// What is written, beside item.json.
struct Outputs {
  std::vector<std::string> files;  ///< names whose ends say what they are (item_files.hpp)
  PicturePlan pictures;
  bool coco = false, webdataset = false;  ///< layouts that are made when all items are there
  int items_per_shard = 1000;             ///< of WebDataset's archives
};

/// One leaf of a plan.
struct Item {
  int number = 0;
  LeafRequest leaf;
  Config config;
  PictureOptions picture;          ///< view, sun and background of its pictures
  std::vector<Assignment> chosen;  ///< what varies, in the order of the keys: "leaf", "water.humidity"
};

/// A plan that has been read and checked: every value lies in its setting's range.
class Plan {
 public:
  /// `folder`: where relative names of files lie; `source` names the text in messages. Throws
  /// Error{configuration} with source, line and what is allowed.
  Plan(std::string_view toml, const std::string& source, const std::filesystem::path& folder);
  Plan(Plan&&) noexcept;
  ~Plan();

  int count() const;  ///< of items
  const Outputs& outputs() const;
  const std::string& text() const;  ///< the TOML

  /// Item `number`, 0 to count() - 1. It depends on the plan and its number alone: the random numbers of a
  /// key are a stream of their own, so that another key disturbs none. O(#settings).
  Item item(int number) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

/// The plan of a file. Throws Error{input} when it cannot be read, else as Plan() does.
Plan read_plan(const std::filesystem::path& file);

/// A part of a plan's items: those whose number leaves `index` - 1 when divided by `of`. 1 <= index <= of.
struct Shard {
  int index = 1, of = 1;
  bool has(int item) const { return item % of == index - 1; }
};

/// "3/7". Throws Error{configuration}.
Shard parse_shard(const std::string& text);

}  // namespace wilt
