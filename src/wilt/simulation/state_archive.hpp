// The variables of a run as named arrays of numbers.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace wilt {

/// Finite numbers, #rows x #columns each, by name.
using StateArrays = std::map<std::string, Eigen::MatrixXd>;

/// Puts variables into arrays, or back: what exchanges them names each variable once, and so saves and
/// restores the same ones. Restoring throws Error{input} for what is missing, of another size or no such
/// number.
class StateArchive {
 public:
  /// Saves to `arrays`.
  static StateArchive saving(StateArrays& arrays) { return {&arrays, nullptr}; }
  /// Restores from `arrays`.
  static StateArchive restoring(const StateArrays& arrays) { return {nullptr, &arrays}; }

  /// A matrix or vector; restored into one that has its size already.
  template <class Derived>
  void matrix(const std::string& name, Eigen::PlainObjectBase<Derived>& values) {
    if (to_ != nullptr)
      (*to_)[name] = values;
    else
      values = saved(name, values.rows(), values.cols());
  }

  /// A list of rows, of any length, by their members: numbers, flags and enumerations.
  template <class Row, class... Member>
  void rows(const std::string& name, std::vector<Row>& list, Member Row::*... members) {
    if (to_ != nullptr) {
      Eigen::MatrixXd table(static_cast<Eigen::Index>(list.size()), sizeof...(members));
      for (Eigen::Index i = 0; i < table.rows(); ++i) {
        Eigen::Index column = 0;
        ((table(i, column++) = static_cast<double>(list[static_cast<std::size_t>(i)].*members)), ...);
      }
      (*to_)[name] = std::move(table);
      return;
    }
    const Eigen::MatrixXd& table = saved(name, Eigen::Dynamic, sizeof...(members));
    list.assign(static_cast<std::size_t>(table.rows()), Row());
    for (Eigen::Index i = 0; i < table.rows(); ++i) {
      Eigen::Index column = 0;
      ((list[static_cast<std::size_t>(i)].*members = number<Member>(name, table(i, column++))), ...);
    }
  }

 private:
  StateArchive(StateArrays* to, const StateArrays* from) : to_(to), from_(from) {}

  // The saved array, which must have this size; Eigen::Dynamic: any.
  const Eigen::MatrixXd& saved(const std::string& name, Eigen::Index rows, Eigen::Index columns) const;

  template <class T>
  static T number(const std::string& name, double value) {
    if (std::is_floating_point_v<T>) return static_cast<T>(value);
    if (!(value >= 0.0 && value <= kLargestCount && value == std::floor(value))) refuse_count(name, value);
    return static_cast<T>(static_cast<int>(value));
  }
  [[noreturn]] static void refuse_count(const std::string& name, double value);

  static constexpr double kLargestCount = 2147483647.0;

  StateArrays* to_;
  const StateArrays* from_;
};

}  // namespace wilt
