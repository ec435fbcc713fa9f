// Which blocks a symmetric sparse matrix has, in an order that lets its rows be swept in parallel.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace wilt {

/// Rows of vertices that a kind of element couples: #elements x (vertices per element).
using Stencil = Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A row per vertex, a block per coupled pair, each diagonal block included. Immutable.
///
/// Rows are sorted by colour, and no two rows of one colour are coupled: a sweep that takes the rows in order
/// (Gauss and Seidel's) may take all of a colour at once, and is as good for it as one in the mesh's own
/// order. Within a colour they are numbered breadth first, so that what is near on the mesh is near in
/// memory. Slots count the blocks row by row, each row by its columns.
class BlockPattern {
 public:
  /// All pairs of vertices that share an element of a stencil. O(#pairs log #pairs). Throws Error{input} for
  /// an index outside [0, vertex_count).
  BlockPattern(int vertex_count, const std::vector<Stencil>& stencils);

  int vertex_count() const { return static_cast<int>(vertices_.size()); }
  int slot_count() const { return static_cast<int>(columns_.size()); }
  int vertex(int row) const { return vertices_[row]; }
  int row(int vertex) const { return rows_[vertex]; }
  int colour_count() const { return static_cast<int>(colour_begin_.size()) - 1; }
  int colour_begin(int c) const {
    return colour_begin_[c];
  }  ///< the first row of colour c; #colours: the end

  int row_begin(int row) const { return row_begin_[row]; }  ///< the first slot of a row; #V: the end
  int diagonal(int row) const { return diagonal_[row]; }    ///< the slot of block (row, row)
  int column(int slot) const { return columns_[slot]; }     ///< a row's number
  int mirror(int slot) const { return mirror_[slot]; }      ///< the slot of the transposed block
  const int* row_begins() const { return row_begin_.data(); }
  const int* diagonals() const { return diagonal_.data(); }
  const int* columns() const { return columns_.data(); }
  int slot(int i, int j) const;  ///< of the block of vertices i and j; -1 when there is none. O(log row)

  /// Per element, the slots of its pairs of vertices (a, b), a <= b in the element's order: #elements x k (k
  /// + 1) / 2.
  Stencil pair_slots(const Stencil& stencil) const;

 private:
  std::vector<int> vertices_, rows_, colour_begin_, row_begin_, columns_, diagonal_, mirror_;
};

}  // namespace wilt
