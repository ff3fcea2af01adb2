#include <snug/advice/coarse_faces.h>
#include <snug/advice/true_bodies.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace snug::advice {
namespace {
/// Fraction of @p i times an irrational number: the additive recurrence, which fills the unit
/// cube evenly. Source: Roberts, "The unreasonable effectiveness of quasirandom sequences" (2018).
double recurrence(unsigned int i, unsigned int axis)
{
  const double root = 1.2207440846057596, whole = 0.5 + (i + 1) * std::pow(root, -1. - axis);
  return whole - std::floor(whole);
}
} // namespace

template <int dim>
TrueBodies<dim>::TrueBodies(const mesh::BodyMesh<dim> &mesh) : mesh(mesh)
{
  for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
    add_patches(body);
  add_seeds(faces, face_seeds);
  add_seeds(cells, cell_seeds);
  dealii::Point<dim> lower = face_seeds.front().x, upper = lower;
  for (const auto &seed : face_seeds)
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], seed.x[d]);
        upper[d] = std::max(upper[d], seed.x[d]);
      }
  diagonal = lower.distance(upper);
}

template <int dim>
void TrueBodies<dim>::add_patches(const unsigned int body)
{
  const auto coarse = mesh.geometry(body).coarse_mesh();
  for (unsigned int cell = 0; cell < coarse.cells.size(); ++cell)
    cells.push_back({body, cell, Patch::cell_itself, 0});
  for (const auto &[cell, face, boundary] : coarse_faces<dim>(coarse))
    faces.push_back({body, cell, face, boundary});
}

/// Few patches may be curved much, many are small.
template <int dim>
void TrueBodies<dim>::add_seeds(const std::vector<Patch> &patches, std::vector<Seed> &seeds)
{
  const unsigned int few = patches.front().face == Patch::cell_itself ? 2 : 4;
  const unsigned int n   = patches.size() < 5000 ? few : 1;
  for (unsigned int p = 0; p < patches.size(); ++p)
    {
      const unsigned int fixed = patches[p].face / 2;
      unsigned int       total = 1;
      for (unsigned int d = 0; d < dim; ++d)
        total *= d == fixed ? 1 : n;
      for (unsigned int i = 0; i < total; ++i)
        {
          dealii::Point<dim> unit;
          for (unsigned int d = 0, rest = i; d < dim; ++d)
            if (d == fixed)
              unit[d] = patches[p].face % 2;
            else
              {
                unit[d] = (rest % n + 0.5) / n;
                rest /= n;
              }
          seeds.push_back({p, unit, at(patches[p], unit)});
        }
    }
}

template <int dim>
dealii::Point<dim> TrueBodies<dim>::at(const Patch &patch, const dealii::Point<dim> &unit) const
{
  return mesh.geometry(patch.body).position({patch.cell, unit});
}

/// dx_i / d unit_j by differences towards the inside, beyond which the map need not go.
template <int dim>
dealii::Tensor<2, dim> TrueBodies<dim>::derivative(const Patch              &patch,
                                                   const dealii::Point<dim> &unit) const
{
  dealii::Tensor<2, dim> J;
  for (unsigned int j = 0; j < dim; ++j)
    {
      const double step  = unit[j] < 0.5 ? 1e-6 : -1e-6;
      auto         moved = unit;
      moved[j] += step;
      const auto slope = (at(patch, moved) - at(patch, unit)) / step;
      for (unsigned int i = 0; i < dim; ++i)
        J[i][j] = slope[i];
    }
  return J;
}

template <int dim>
Place<dim> TrueBodies<dim>::place(const Patch &patch, const dealii::Point<dim> &unit) const
{
  Place<dim> result{patch.body, patch.cell, patch.boundary, at(patch, unit), {}};
  if (patch.face == Patch::cell_itself)
    return result;
  // the gradient of the coordinate that is constant on the face
  const auto inverse = invert(derivative(patch, unit));
  result.normal      = (patch.face % 2 == 1 ? 1. : -1.) * inverse[patch.face / 2];
  result.normal /= result.normal.norm();
  return result;
}

/// Gauss and Newton, held within the patch: where @p x lies on it, the error squares in each step.
template <int dim>
dealii::Point<dim> TrueBodies<dim>::closest(const Patch              &patch,
                                            dealii::Point<dim>        unit,
                                            const dealii::Point<dim> &x) const
{
  const unsigned int fixed = patch.face / 2;
  for (unsigned int step = 0; step < 12; ++step)
    {
      const auto             off = x - at(patch, unit);
      const auto             J   = derivative(patch, unit);
      dealii::Tensor<2, dim> JJ  = transpose(J) * J;
      dealii::Tensor<1, dim> r   = transpose(J) * off;
      if (fixed < dim)
        {
          for (unsigned int d = 0; d < dim; ++d)
            JJ[fixed][d] = JJ[d][fixed] = d == fixed ? 1. : 0.;
          r[fixed] = 0.;
        }
      if (determinant(JJ) == 0.)
        break;
      const auto move = invert(JJ) * r;
      for (unsigned int d = 0; d < dim; ++d)
        unit[d] = std::clamp(unit[d] + move[d], 0., 1.);
      if (move.norm() < 1e-9)
        break;
    }
  return unit;
}

template <int dim>
std::vector<Place<dim>> TrueBodies<dim>::spread(const std::vector<const Patch *> &patches,
                                                const unsigned int                n) const
{
  std::vector<Place<dim>> result;
  for (unsigned int i = 0; i < n && !patches.empty(); ++i)
    {
      const Patch       &patch = *patches[unsigned(recurrence(i, dim) * patches.size())];
      const auto         fixed = patch.face / 2;
      dealii::Point<dim> unit;
      for (unsigned int d = 0; d < dim; ++d)
        unit[d] = d == fixed ? patch.face % 2 : 0.02 + 0.96 * recurrence(i, d);
      result.push_back(place(patch, unit));
    }
  return result;
}

template <int dim>
std::vector<Place<dim>> TrueBodies<dim>::surface_points(const unsigned int n) const
{
  std::map<std::pair<unsigned int, unsigned int>, std::vector<const Patch *>> of_boundary;
  for (const auto &face : faces)
    of_boundary[{face.body, face.boundary}].push_back(&face);
  std::vector<Place<dim>> result;
  for (const auto &item : of_boundary)
    for (const auto &place : spread(item.second, n))
      result.push_back(place);
  return result;
}

template <int dim>
std::vector<Place<dim>> TrueBodies<dim>::inner_points(const unsigned int n) const
{
  std::vector<std::vector<const Patch *>> of_body(mesh.n_bodies());
  for (const auto &cell : cells)
    of_body[cell.body].push_back(&cell);
  std::vector<Place<dim>> result;
  for (const auto &patches : of_body)
    for (const auto &place : spread(patches, n))
      result.push_back(place);
  return result;
}

/// Bodies that touch have opposite normals.
template <int dim>
std::optional<Place<dim>> TrueBodies<dim>::find(const dealii::Point<dim>     &x,
                                                const dealii::Tensor<1, dim> &normal) const
{
  const bool                                   inside  = normal.norm() == 0.;
  const auto                                  &seeds   = inside ? cell_seeds : face_seeds;
  const auto                                  &patches = inside ? cells : faces;
  std::vector<std::pair<double, const Seed *>> near(std::min<std::size_t>(seeds.size(), 64));
  std::vector<std::pair<double, const Seed *>> all;
  for (const auto &seed : seeds)
    all.push_back({seed.x.distance_square(x), &seed});
  std::partial_sort_copy(all.begin(), all.end(), near.begin(), near.end(),
                         [](const auto &a, const auto &b) { return a.first < b.first; });
  std::vector<unsigned int> tried;
  for (const auto &item : near)
    {
      const unsigned int p = item.second->patch;
      if (std::count(tried.begin(), tried.end(), p) > 0)
        continue;
      tried.push_back(p);
      const auto unit = closest(patches[p], item.second->unit, x);
      if (at(patches[p], unit).distance(x) > 1e-6 * diagonal)
        continue;
      const auto found = place(patches[p], unit);
      if (inside || (found.normal - normal).norm() < 1e-2)
        return found;
    }
  return {};
}

template class TrueBodies<2>;
template class TrueBodies<3>;
} // namespace snug::advice
