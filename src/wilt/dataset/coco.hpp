// COCO: one JSON file that says what is where in all pictures of a data set.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "wilt/core/file_writer.hpp"
#include "wilt/core/image.hpp"

namespace wilt {

/// A picture with one leaf.
struct CocoPicture {
  std::string file_name;  ///< as the JSON shall have it: relative to the folder of the pictures
  std::string category;   ///< what the leaf is: its species
  std::string mask;       ///< bytes of the leaf's mask, a PNG: 0 beside the leaf
  std::string labels;     ///< JSON text, label_json() of label_files.hpp
};

/// Object-detection annotations in the form of COCO (cocodataset.org, "Data format"), written as they come.
///
/// "images" (id from 1, width, height, file_name); "annotations", one for each picture that shows a leaf:
/// bbox [left, top, width, height], area, segmentation as run lengths {"counts", "size": [height, width]}
/// (column by column, background first), iscrowd 0, keypoints base and apex [x, y, v], and beyond COCO "tips"
/// [[x, y, v]]; "categories" in the order in which they come. Pixels; an x or y of 0 is the picture's edge.
/// Memory: the images' lines, some 100 bytes a picture. The same pictures give the same bytes.
class CocoWriter {
 public:
  /// Throws Error{output} when `path` cannot be written.
  explicit CocoWriter(const std::string& path);

  /// Throws Error{input}, naming the picture, for a mask or labels that cannot be read or do not fit each
  /// other; Error{output}.
  void add(const CocoPicture& picture);

  /// The file appears, whole. Throws Error{output}.
  void finish();

 private:
  int category_id(const std::string& name);

  FileWriter file_;
  std::string images_;  // lines of JSON
  std::vector<std::string> categories_;
  int pictures_ = 0, annotations_ = 0;
};

/// Lengths of the runs of a mask read column by column, background (0, of the first channel) first, which may
/// be of length 0. Their sum is width * height.
std::vector<std::uint32_t> run_lengths(const Image& mask);

}  // namespace wilt
