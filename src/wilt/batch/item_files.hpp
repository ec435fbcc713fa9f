// The files of one item of a plan.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "wilt/batch/plan.hpp"
#include "wilt/batch/prepared_leaves.hpp"
#include "wilt/core/monitor.hpp"

namespace wilt {

/// The labels of an item and the list of its files: written last, so that with it the item is whole.
inline constexpr const char* kItemLabels = "item.json";

/// What an item is called in folders and archives: "000017".
std::string item_name(int number);

/// Throws Error{configuration} unless every name is that of a file in the item's folder whose end says what
/// it is: a result (result_formats.hpp), or one of report.json, forces.csv, veins.json, veins.svg.
void check_item_files(const std::vector<std::string>& names);

/// A picture of an item is called picture.png, or by its place in the clip picture.00.png, picture.01.png
/// ...; its label pictures picture.leaf.png and so on.
std::string picture_stem(int picture, int pictures);

/// What varies of the item as a JSON object by key: numbers and truth values as such, else words.
std::string chosen_json(const Item& item);

/// Withers the item and writes its files into `folder`, which exists and is empty.
///
/// item.json: "item", "fingerprint", "chosen" {key: value}, what report.json has but its times and steps,
/// "pictures" [{"file", "frame", "iteration" and what label_json() says}], "files" {name: {"bytes",
/// "sha256"}}. Nothing in the files depends on the time, the machine or the folder. Throws Error{simulation}
/// when the leaf stops, Error{output} when the folder takes no more, Error{interrupted}, and what reading a
/// leaf throws.
void make_item(const Item& item, const Outputs& outputs, const std::string& fingerprint,
               const std::filesystem::path& folder, PreparedLeaves& leaves, const Monitor& monitor);

}  // namespace wilt
