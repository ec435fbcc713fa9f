#include "wilt/render/resting_pose.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <vector>

namespace wilt {
namespace {

constexpr int kMaxTips = 64;

/// A body on a table at height 0, with the points that it stands on.
class Body {
 public:
  Body(const Points3& points, const Vec3& centre) : points_(points), centre_(centre) {
    int lowest = 0;
    points_.col(2).minCoeff(&lowest);
    contacts_ = {lowest};
    size_ = (points_.colwise().maxCoeff() - points_.colwise().minCoeff()).norm();
  }

  const Eigen::Matrix3d& rotation() const { return rotation_; }

  /// Tips once; false when the body stands, or nothing stops it from turning over.
  bool tip() {
    const Vec3 pivot = contact(0);
    Vec3 falling;  // horizontal, away from the contacts, towards the side that goes down
    if (contacts_.size() == 1) {
      falling = horizontal(centre_ - pivot);
    } else {
      const Vec3 edge = horizontal(contact(1) - pivot).normalized();
      const Vec3 over = horizontal(centre_ - pivot);
      falling = over - edge * edge.dot(over);
    }
    if (falling.norm() <= 1e-9 * size_) return false;
    falling.normalize();

    int next = -1;
    double angle = std::numeric_limits<double>::infinity();
    for (int i = 0; i < points_.rows(); ++i) {
      const Vec3 offset = points_.row(i).transpose() - pivot;
      const double ahead = offset.dot(falling);
      if (ahead <= 1e-6 * size_) continue;
      const double touches = std::atan2(offset.z(), ahead);
      if (touches < angle) angle = touches, next = i;
    }
    if (next < 0) return false;
    turn(pivot, Eigen::AngleAxisd(angle, Vec3::UnitZ().cross(falling)).toRotationMatrix());
    contacts_.push_back(next);
    return contacts_.size() < 3 || drop_a_contact();
  }

 private:
  static Vec3 horizontal(const Vec3& v) { return {v.x(), v.y(), 0.0}; }
  Vec3 contact(int k) const { return points_.row(contacts_[std::size_t(k)]).transpose(); }

  void turn(const Vec3& pivot, const Eigen::Matrix3d& by) {
    points_ =
        (((points_.rowwise() - pivot.transpose()) * by.transpose()).rowwise() + pivot.transpose()).eval();
    centre_ = by * (centre_ - pivot) + pivot;
    rotation_ = by * rotation_;
  }

  /// Of three contacts keeps the edge that the centre hangs over; false when it hangs over none.
  bool drop_a_contact() {
    double farthest = 1e-9 * size_;
    int drop = -1;
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = contact((k + 1) % 3), edge = horizontal(contact((k + 2) % 3) - a).normalized();
      const auto beside = [&](const Vec3& p) -> Vec3 {
        const Vec3 offset = horizontal(p - a);
        return offset - edge * edge.dot(offset);
      };
      const Vec3 inner = beside(contact(k)).normalized();
      const double outside = -inner.dot(beside(centre_));
      if (outside > farthest) farthest = outside, drop = k;
    }
    if (drop < 0) return false;
    contacts_.erase(contacts_.begin() + drop);
    return true;
  }

  Points3 points_;
  Vec3 centre_;
  double size_ = 0.0;
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  std::vector<int> contacts_;
};

}  // namespace

Eigen::Matrix3d resting_rotation(const Points3& points, const Vec3& centre) {
  Body body(points, centre);
  for (int i = 0; i < kMaxTips && body.tip(); ++i) {
  }
  return body.rotation();
}

}  // namespace wilt
