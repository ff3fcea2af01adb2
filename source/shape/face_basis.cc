#include <snug/shape/face_basis.h>

namespace snug::shape {
template <int dim>
FaceBasis<dim>::FaceBasis(std::unique_ptr<ShapedFace<dim>> face,
                          std::unique_ptr<FaceModes<dim>>  modes,
                          std::unique_ptr<Interior<dim>>   interior)
  : face(std::move(face)), modes(std::move(modes)), interior(std::move(interior))
{}

template <int dim>
unsigned int FaceBasis<dim>::n_variables() const
{
  return modes->n_variables();
}

/// Modes are free to move hanging nodes anywhere; C puts them back on the lines or faces of their
/// masters, or the mesh would tear open there.
template <int dim>
typename FaceBasis<dim>::Field FaceBasis<dim>::apply(const std::vector<double> &alpha) const
{
  auto moves = modes->apply(alpha);
  face->interpolate_hanging(moves);
  return interior->extend(moves);
}

/// V' = M'C'E': the transposes in reverse order.
template <int dim>
std::vector<double> FaceBasis<dim>::transpose(const Field &gradient) const
{
  auto at_face = interior->transpose(gradient);
  face->distribute_hanging(at_face);
  return modes->transpose(at_face);
}

/// C and E do not change which control points there are.
template <int dim>
std::vector<Control<dim>> FaceBasis<dim>::controls() const
{
  return modes->controls();
}

template <int dim>
std::vector<std::pair<unsigned int, unsigned int>> FaceBasis<dim>::faces() const
{
  return {{face->body(), face->boundary()}};
}

template class FaceBasis<2>;
template class FaceBasis<3>;
} // namespace snug::shape
