#include <snug/base/errors.h>
#include <snug/state/cell_checks.h>

#include <sstream>

namespace snug::state {
namespace {
/// Cells below this quality are not solved (see Element::quality).
const double least_quality = 0.02;
} // namespace

template <int dim>
std::string flaw_of_cell(const std::string            &body,
                         const dealii::Tensor<1, dim> &x,
                         const double                  quality,
                         const double                  jacobian,
                         const double                  least_jacobian)
{
  if (quality >= least_quality && jacobian >= least_jacobian)
    return "";
  std::ostringstream text;
  text << "the mesh of body " << body << " is tangled near (" << x << "): ";
  if (quality < least_quality)
    text << "cell quality " << quality << " is below " << least_quality;
  else
    text << "scaled Jacobian " << jacobian
         << " is below 'Least scaled Jacobian' = " << least_jacobian;
  return text.str();
}

template <int dim>
void check_cells(const mesh::BodyMesh<dim>                   &mesh,
                 const Model<dim>                            &model,
                 const std::vector<elasticity::Element<dim>> &elements)
{
  for (const auto &cell : mesh.cells())
    {
      std::vector<dealii::Tensor<1, dim>> X;
      for (const unsigned int node : cell.nodes)
        X.push_back(mesh.reference_positions()[node]);
      const auto [quality, jacobian] = elements[cell.body].qualities(X);
      const auto found = flaw_of_cell(model.body_names[cell.body], X.front(), quality, jacobian,
                                      model.least_scaled_jacobian);
      if (!found.empty())
        throw InputError(found + " in the initial mesh; check its 'Warp' and 'Curved faces'");
    }
}

#define SNUG_INSTANTIATE(dim)                                                                    \
  template std::string flaw_of_cell(const std::string &, const dealii::Tensor<1, dim> &, double, \
                                    double, double);                                             \
  template void        check_cells(const mesh::BodyMesh<dim> &, const Model<dim> &,              \
                                   const std::vector<elasticity::Element<dim>> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::state
