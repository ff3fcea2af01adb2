#include <snug/accuracy/applied_forces.h>

namespace snug::accuracy {
template <int dim>
AppliedForces<dim>::AppliedForces(const state::StateSolver<dim>  &solver,
                                  const state::ContactState<dim> &state)
  : model(solver.model())
  , bodies(solver.model().load_cases[state.load_case].bodies)
  , tractions(solver.resultants().tractions(state.positions)[state.load_case])
{}

/// Return the load of a face, or null if it has none.
template <int dim>
const state::BoundaryLoad<dim> *AppliedForces<dim>::load(const Face &face) const
{
  const auto &boundaries = bodies[face.body].boundaries;
  const auto  found      = boundaries.find(face.boundary);
  return found == boundaries.end() ? nullptr : &found->second;
}

template <int dim>
bool AppliedForces<dim>::has_more(const Face &face, const LoadedDisplacement<dim> &of)
{
  return of.more && of.more->traction &&
         of.more->boundary == std::make_pair(face.body, face.boundary);
}

template <int dim>
bool AppliedForces<dim>::act_on(const Face &face, const LoadedDisplacement<dim> &of) const
{
  return has_more(face, of) || (of.loads != 0. && load(face));
}

template <int dim>
dealii::Tensor<1, dim> AppliedForces<dim>::by_area(const Face                    &face,
                                                   const FacePoint<dim>          &point,
                                                   const LoadedDisplacement<dim> &of) const
{
  const double           dA = point.area.norm();
  dealii::Tensor<1, dim> force;
  if (const auto *given = of.loads != 0. ? load(face) : nullptr)
    force = of.loads * given->force_at(dealii::Point<dim>(point.reference), point.area);
  if (has_more(face, of))
    force += dA * of.more->traction(point.area / dA, point.position);
  return force;
}

template <int dim>
dealii::Tensor<1, dim> AppliedForces<dim>::spread(const Face                    &face,
                                                  const FacePoint<dim>          &point,
                                                  const LoadedDisplacement<dim> &of) const
{
  const auto found = tractions.find({face.body, face.boundary});
  if (of.loads == 0. || found == tractions.end())
    return {};
  return of.loads * point.area.norm() * found->second.value(point.position);
}

template <int dim>
bool AppliedForces<dim>::act_in(const Cell &cell, const LoadedDisplacement<dim> &of) const
{
  return of.loads != 0. && bodies[cell.body].has_force_per_volume();
}

template <int dim>
dealii::Tensor<1, dim> AppliedForces<dim>::by_volume(const Cell                    &cell,
                                                     const dealii::Tensor<1, dim>  &reference,
                                                     const LoadedDisplacement<dim> &of) const
{
  return of.loads *
         bodies[cell.body].force_per_volume(model.bodies[cell.body].material(cell), reference);
}

template class AppliedForces<2>;
template class AppliedForces<3>;
} // namespace snug::accuracy
