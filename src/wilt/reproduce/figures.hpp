// The figures and tables of the paper, one function each; inside the reproduce room only.
//
// Each writes its pictures and plots through the workshop and gives its section of the report with the claims
// as measured. Deterministic. Throws Error{output, interrupted}.
#pragma once

#include "wilt/reproduce/figure.hpp"
#include "wilt/reproduce/workshop.hpp"

namespace wilt::detail {

Figure table_1(Workshop& workshop);    ///< parameters
Figure table_2(Workshop& workshop);    ///< initial external forces
Figure figure_2(Workshop& workshop);   ///< boundary expansion
Figure figure_5(Workshop& workshop);   ///< mass of the cells
Figure figure_6(Workshop& workshop);   ///< veins of six species
Figure figure_7(Workshop& workshop);   ///< swelling wrinkles, external forces curl
Figure figure_8(Workshop& workshop);   ///< from fresh to withered
Figure figure_9(Workshop& workshop);   ///< forces over the iterations
Figure figure_10(Workshop& workshop);  ///< swelling force and water loss
Figure figure_11(Workshop& workshop);  ///< wrinkles and water loss
Figure figure_12(Workshop& workshop);  ///< variants of the external force
Figure figure_13(Workshop& workshop);  ///< range of the external force
Figure figure_14(Workshop& workshop);  ///< non-uniform and uniform mass
Figure figure_15(Workshop& workshop);  ///< against other models: its place

}  // namespace wilt::detail
