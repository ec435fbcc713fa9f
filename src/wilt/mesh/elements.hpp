// Typed indices of a mesh's elements and values keyed by them.
#pragma once

#include <cstddef>
#include <vector>

namespace wilt {

/// An index that knows what it counts: made from an int only on purpose, read as an int freely.
template <class Tag>
class ElementId {
 public:
  constexpr ElementId() = default;
  constexpr explicit ElementId(int index) : index_(index) {}
  template <class Other>
  ElementId(ElementId<Other>) = delete;

  constexpr operator int() const { return index_; }  // NOLINT(google-explicit-constructor): reads are free
  constexpr bool valid() const { return index_ >= 0; }
  ElementId& operator++() {
    ++index_;
    return *this;
  }

 private:
  int index_ = -1;
};

using VertexId = ElementId<struct VertexTag>;
using HalfedgeId = ElementId<struct HalfedgeTag>;
using EdgeId = ElementId<struct EdgeTag>;
using FaceId = ElementId<struct FaceTag>;

/// The ids 0 .. count-1, for range-based loops.
template <class Id>
class IdRange {
 public:
  class Iterator {
   public:
    explicit Iterator(int index) : id_(index) {}
    Id operator*() const { return id_; }
    Iterator& operator++() {
      ++id_;
      return *this;
    }
    bool operator!=(const Iterator& other) const {
      return static_cast<int>(id_) != static_cast<int>(other.id_);
    }

   private:
    Id id_;
  };

  explicit IdRange(int count) : count_(count) {}
  Iterator begin() const { return Iterator(0); }
  Iterator end() const { return Iterator(count_); }

 private:
  int count_;
};

/// One value per element of a kind. Indexing vertex data by a face does not compile.
template <class Id, class T>
class ElementData {
 public:
  ElementData() = default;
  explicit ElementData(int count, const T& value = T()) : values_(static_cast<std::size_t>(count), value) {}

  decltype(auto) operator[](Id id) { return values_[static_cast<std::size_t>(static_cast<int>(id))]; }
  decltype(auto) operator[](Id id) const { return values_[static_cast<std::size_t>(static_cast<int>(id))]; }
  template <class Other>
  T& operator[](Other) = delete;

  int size() const { return static_cast<int>(values_.size()); }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }
  const std::vector<T>& values() const { return values_; }

 private:
  std::vector<T> values_;
};

template <class T>
using VertexData = ElementData<VertexId, T>;
template <class T>
using EdgeData = ElementData<EdgeId, T>;
template <class T>
using FaceData = ElementData<FaceId, T>;

}  // namespace wilt
