#include "wilt/simulation/deformation_model.hpp"

#include "wilt/core/error.hpp"
#include "wilt/core/nearest.hpp"
#include "wilt/simulation/cell_model.hpp"
#include "wilt/simulation/paper_model.hpp"

namespace wilt {

const std::vector<std::string>& model_names() {
  static const std::vector<std::string> names = {"paper", "cell"};
  return names;
}

std::unique_ptr<DeformationModel> make_model(const ModelInput& input) {
  const std::string& name = input.config.model;
  if (name == "paper") return std::make_unique<PaperModel>(input);
  if (name == "cell") return std::make_unique<CellModel>(input);
  throw Error(ErrorCode::configuration, "unknown model '" + name + "'" + did_you_mean(name, model_names()));
}

}  // namespace wilt
