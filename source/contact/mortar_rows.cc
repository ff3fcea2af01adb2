#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/base/shared_work.h>
#include <snug/contact/mortar_rows.h>
#include <snug/contact/opposite_faces.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace snug::contact {
namespace {
/// Faces covered less than this have standard multiplier functions.
const double least_biorthogonal_cover = 0.25;

/// Covered but for this part of its extent a face counts as covered there, so that its nodes keep
/// rows of their own where curved sides end together.
const double uncovered_edge = 0.01;

/// A node is held if its supports leave less than this of its normal.
const double held_part = 0.1;

/// Integrals of the shape functions over a whole face.
/// With the same number of Gauss points as tributary areas have.
template <int dim>
std::vector<double> whole_integrals(const mesh::Surface<dim>                 &surface,
                                    unsigned int                              face,
                                    const faces::FaceShape<dim>              &shape,
                                    const typename mesh::Surface<dim>::Field &positions)
{
  const auto                   &nodes = surface.faces()[face].nodes;
  const dealii::QGauss<dim - 1> gauss(shape.degree() + 2);
  std::vector<double>           result(nodes.size(), 0.);
  for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const auto             values = shape.at(gauss.point(q));
      dealii::Tensor<1, dim> x;
      for (unsigned int k = 0; k < nodes.size(); ++k)
        x += values.value[k] * positions[nodes[k]];
      const double weight =
        gauss.weight(q) * surface.idealization().weight(x) *
        faces::area_vector(faces::tangents<dim>(values, nodes, positions)).norm();
      for (unsigned int k = 0; k < nodes.size(); ++k)
        result[k] += weight * values.value[k];
    }
  return result;
}

double sum(const std::vector<double> &values)
{
  return std::accumulate(values.begin(), values.end(), 0.);
}
} // namespace

template <int dim>
MortarRows<dim>::MortarRows(const PairGeometry<dim> &pair)
  : surface(pair.surface)
  , shape(pair.shape)
  , quadrature(shape.degree(), surface.idealization())
  , sides(pair.sides)
  , held(pair.held)
{
  const auto opposite = opposite_faces(pair);
  for (unsigned int i = 0; i < sides.slave.size(); ++i)
    if (!opposite[i].empty())
      faces.push_back({sides.slave[i], opposite[i], {}});
  choose_multipliers(pair);
  collect_row_nodes();
  leave_out_far_rows(pair);
}

template <int dim>
void MortarRows<dim>::choose_multipliers(const PairGeometry<dim> &pair)
{
  const faces::NodalNormals<dim> normals(surface, sides.slave, shape, pair.positions);
  std::vector<bool>              is_held(surface.n_nodes());
  for (unsigned int node = 0; node < is_held.size(); ++node)
    is_held[node] =
      pair.taken[node] || faces::free_part(normals.normals()[node], held[node]).norm() < held_part;
  const auto x     = mortar::node_arrays<dim>(pair.positions);
  const auto parts = all_integrals<double>(x);
  const auto boxes = shared_work(surface.communicator(), costs(), [&](const unsigned int f) {
    const auto          box = cover_box(faces[f], x);
    std::vector<double> ends(box.lower.begin(), box.lower.end());
    ends.insert(ends.end(), box.upper.begin(), box.upper.end());
    return ends;
  });
  std::vector<mortar::FaceCover> covers;
  for (unsigned int f = 0; f < faces.size(); ++f)
    {
      mortar::CoverBox<dim> box;
      std::copy_n(boxes[f].begin(), dim - 1, box.lower.begin());
      std::copy_n(boxes[f].begin() + dim - 1, dim - 1, box.upper.begin());
      const auto cover = choose_functions(faces[f], parts[f], box, pair.positions);
      // Opposite within the margin of the pairing, but not covered yet: no multipliers.
      if (sum(cover.covered) > 0.)
        covers.push_back(cover);
    }
  multipliers = mortar::choose_multiplier_nodes(surface, covers, is_held, pair.positions);
}

/// The cover of a face, by the functions it gets.
template <int dim>
mortar::FaceCover MortarRows<dim>::choose_functions(SlaveFace                           &face,
                                                    const mortar::FaceIntegrals<double> &of_nodes,
                                                    const mortar::CoverBox<dim>         &box,
                                                    const Field &positions) const
{
  mortar::FaceCover cover = {face.face, of_nodes.slave,
                             whole_integrals(surface, face.face, shape, positions)};
  // The Gram matrix of shape functions over a sliver of a face is nearly singular: its inverse
  // would give multiplier functions with large values of both signs.
  if (sum(cover.covered) < least_biorthogonal_cover * sum(cover.whole))
    {
      face.functions.biorthogonal = false;
      return cover;
    }
  face.functions = mortar::functions_on(box, shape.degree(), uncovered_edge);
  cover.covered  = mortar::in_box(of_nodes, face.functions).slave;
  return cover;
}

/// The part of the face that is covered lies within.
template <int dim>
mortar::CoverBox<dim> MortarRows<dim>::cover_box(const SlaveFace                      &face,
                                                 const mortar::FaceNodes<dim, double> &x) const
{
  mortar::CoverBox<dim> box;
  const auto            slave = mortar::mortar_face<dim>(surface, shape, face.face, x).nodes;
  for (const unsigned int master : face.masters)
    quadrature.add_cover(slave, mortar::mortar_face<dim>(surface, shape, master, x).nodes, box);
  return box;
}

/// Of the slave faces: cutting a pair of faces is what takes time.
template <int dim>
std::vector<double> MortarRows<dim>::costs() const
{
  std::vector<double> result;
  for (const SlaveFace &face : faces)
    result.push_back(double(face.masters.size()));
  return result;
}

/// All nodes that a row may reach while the pairing stays, those with zero coefficients included:
/// B keeps its pattern while the design moves, and its symbolic factorizations stay valid.
template <int dim>
void MortarRows<dim>::collect_row_nodes()
{
  std::vector<std::set<unsigned int>> reached(multipliers.nodes.size());
  for (const SlaveFace &face : faces)
    {
      const auto               &nodes = surface.faces()[face.face].nodes;
      std::vector<unsigned int> masters;
      for (const unsigned int master : face.masters)
        {
          const auto &of_face = surface.faces()[master].nodes;
          masters.insert(masters.end(), of_face.begin(), of_face.end());
        }
      for (const unsigned int node : nodes)
        for (const auto &share : multipliers.shares[node])
          {
            auto &row = reached[share.first];
            row.insert(masters.begin(), masters.end());
            // int psi_j N_l = 0 for l != j: of the slave side only the node itself.
            if (face.functions.are_nodal())
              row.insert(node);
            else
              row.insert(nodes.begin(), nodes.end());
          }
    }
  for (const auto &nodes : reached)
    {
      // Hanging nodes have no unknowns.
      std::set<unsigned int> resolved;
      for (const unsigned int node : nodes)
        {
          if (surface.masters(node).empty())
            resolved.insert(node);
          for (const auto &master : surface.masters(node))
            resolved.insert(master.first);
        }
      row_nodes.emplace_back(resolved.begin(), resolved.end());
    }
}

/// Far rows take their multiplier functions along, so shares may sum to less than 1 afterwards: a
/// part of the side that is out of reach carries no pressure.
template <int dim>
void MortarRows<dim>::leave_out_far_rows(const PairGeometry<dim> &pair)
{
  const Opposition<dim>         opposition(pair);
  const auto                    all           = rows(pair.positions);
  const mortar::MultiplierNodes old           = multipliers;
  const auto                    old_row_nodes = row_nodes;
  std::vector<unsigned int>     index(all.size(), all.size());
  multipliers.nodes.clear();
  row_nodes.clear();
  for (unsigned int i = 0; i < all.size(); ++i)
    // By the gap alone: the angles of faces were tested when they were paired.
    if (opposition.is_near(all[i].gap))
      {
        index[i] = row_nodes.size();
        multipliers.nodes.push_back(old.nodes[i]);
        row_nodes.push_back(old_row_nodes[i]);
      }
  for (auto &shares : multipliers.shares)
    {
      mortar::MultiplierNodes::Shares kept;
      for (const auto &share : shares)
        if (index[share.first] < all.size())
          kept.emplace_back(index[share.first], share.second);
      shares = kept;
    }
}

template <int dim>
template <typename Number>
mortar::FaceIntegrals<Number>
MortarRows<dim>::integrals(const SlaveFace &face, const mortar::FaceNodes<dim, Number> &x) const
{
  std::vector<mortar::MortarFace<dim, Number>> masters;
  for (const unsigned int master : face.masters)
    masters.push_back(mortar::mortar_face<dim>(surface, shape, master, x));
  return mortar::integrate<dim>(quadrature, mortar::mortar_face<dim>(surface, shape, face.face, x),
                                masters);
}

template <int dim>
template <typename Number>
std::vector<mortar::FaceIntegrals<Number>>
MortarRows<dim>::all_integrals(const mortar::FaceNodes<dim, Number> &x) const
{
  const auto numbers = shared_work(surface.communicator(), costs(), [&](const unsigned int f) {
    return mortar::to_numbers(integrals(faces[f], x));
  });
  std::vector<mortar::FaceIntegrals<Number>> result;
  for (unsigned int f = 0; f < faces.size(); ++f)
    result.push_back(mortar::from_numbers<dim, Number>(
      narrow<unsigned int>(surface.faces()[faces[f].face].nodes.size()),
      narrow<unsigned int>(faces[f].masters.size()), numbers[f].begin()));
  return result;
}

/// The parts of rows that are integrals over one slave face.
template <int dim>
template <typename Number>
void MortarRows<dim>::add_face(const SlaveFace                      &face,
                               const mortar::FaceIntegrals<Number>  &of_shapes,
                               const mortar::FaceNodes<dim, Number> &x,
                               std::vector<RowSum<Number>>          &sums) const
{
  const auto  coupling = mortar::couple(of_shapes, face.functions);
  const auto &nodes    = surface.faces()[face.face].nodes;
  // int psi_j N at one node of a face: coefficient and part of the gap
  const auto add = [&](unsigned int j, unsigned int node, const Number &integral) {
    for (const auto &share : multipliers.shares[nodes[j]])
      {
        RowSum<Number> &sum    = sums[share.first];
        const Number    shared = share.second * integral;
        for_each_place(share.first, node, [&](unsigned int place, double weight) {
          sum.coefficients[place] += weight * shared;
        });
        for (int d = 0; d < dim; ++d)
          // Hanging nodes at their own position, though their coefficients went to their
          // masters: the gap is one between the faces as they are.
          sum.offset[d] -= shared * x[node][d];
      }
  };
  for (unsigned int j = 0; j < nodes.size(); ++j)
    {
      for (const auto &share : multipliers.shares[nodes[j]])
        {
          sums[share.first].area += share.second * coupling.multiplier[j];
          for (int d = 0; d < dim; ++d)
            sums[share.first].offset[d] += share.second * coupling.multiplier_offset(j, d);
        }
      for (unsigned int l = 0; l < nodes.size(); ++l)
        // The other integrals are zero up to rounding, and their nodes may not be in the row.
        if (!face.functions.are_nodal() || l == j)
          add(j, nodes[l], coupling.multiplier_slave(j, l));
      for (unsigned int f = 0; f < face.masters.size(); ++f)
        {
          const auto &master = surface.faces()[face.masters[f]].nodes;
          for (unsigned int k = 0; k < master.size(); ++k)
            {
              add(j, master[k], -coupling.multiplier_master[f](j, k));
              for (const auto &share : multipliers.shares[nodes[j]])
                for_each_place(share.first, master[k], [&](unsigned int place, double weight) {
                  // Of hanging nodes of degree 2, weights and shares may be negative.
                  sums[share.first].weights[place] +=
                    std::abs(weight * share.second) * of_shapes.weights[f](j, k);
                });
            }
        }
    }
}

template <int dim>
template <typename Number>
std::vector<typename MortarRows<dim>::template RowSum<Number>>
MortarRows<dim>::row_sums(const mortar::FaceNodes<dim, Number> &x) const
{
  std::vector<RowSum<Number>> sums(row_nodes.size());
  for (unsigned int i = 0; i < sums.size(); ++i)
    {
      sums[i].coefficients.resize(row_nodes[i].size());
      sums[i].weights.resize(row_nodes[i].size());
    }
  const auto parts = all_integrals<Number>(x);
  for (unsigned int f = 0; f < faces.size(); ++f)
    add_face(faces[f], parts[f], x, sums);
  for (const auto &sum : sums)
    // The row is divided by its area.
    if (!(faces::value_of(sum.area) > 0.))
      throw TangledMesh("the master side has moved away from contact "
                        "nodes that it was opposite to");
  return sums;
}

template <int dim>
template <typename Number>
mortar::MomentCorrection<dim, Number>
MortarRows<dim>::correction(unsigned int                          i,
                            const RowSum<Number>                 &sum,
                            const mortar::FaceNodes<dim, Number> &x,
                            const std::array<Number, dim>        &n) const
{
  mortar::FaceNodes<dim, Number> relative;
  for (const unsigned int node : row_nodes[i])
    {
      relative.push_back(x[node]);
      for (int d = 0; d < dim; ++d)
        relative.back()[d] -= x[multipliers.nodes[i]][d];
    }
  return {relative, sum.coefficients, sum.weights, n};
}

/// Hanging nodes are left out: they have no unknowns whose force could be asked for.
template <int dim>
std::vector<SharedNode> MortarRows<dim>::shared_nodes() const
{
  std::vector<bool> own(surface.n_nodes(), false);
  for (const unsigned int node : multipliers.nodes)
    own[node] = true;
  std::vector<SharedNode> result;
  for (unsigned int node = 0; node < surface.n_nodes(); ++node)
    if (!own[node] && surface.masters(node).empty() && !multipliers.shares[node].empty())
      result.push_back({node, multipliers.shares[node]});
  return result;
}

template <int dim>
std::vector<Row<dim>> MortarRows<dim>::rows(const Field &positions) const
{
  const SupportedNormals<dim> normals(surface, sides.slave, shape, positions, held);
  const auto                  x    = mortar::node_arrays<dim>(positions);
  const auto                  n    = mortar::node_arrays<dim>(normals.normals());
  const auto                  sums = row_sums<double>(x);
  std::vector<Row<dim>>       result(sums.size());
  for (unsigned int i = 0; i < sums.size(); ++i)
    {
      Row<dim> &row = result[i];
      row.normal    = normals.normals()[multipliers.nodes[i]];
      for (int d = 0; d < dim; ++d)
        row.gap += row.normal[d] * sums[i].offset[d] / sums[i].area;
      const auto corrected = correction(i, sums[i], x, n[multipliers.nodes[i]]);
      for (unsigned int k = 0; k < row_nodes[i].size(); ++k)
        row.coefficients.emplace_back(row_nodes[i][k],
                                      (sums[i].coefficients[k] - corrected.masses()[k]) /
                                        sums[i].area * row.normal);
    }
  return result;
}

template <int dim>
std::vector<Row<dim>> MortarRows<dim>::row_derivatives(const Field &positions,
                                                       const Field &velocity) const
{
  const SupportedNormals<dim> normals(surface, sides.slave, shape, positions, held);
  const Field                 normal_slopes = normals.derivative(velocity);
  // One pass over the segments gives values and derivatives, exact through cuts and projections.
  const auto            x          = mortar::node_arrays<dim>(positions, velocity);
  const auto            with_slope = mortar::node_arrays<dim>(normals.normals(), normal_slopes);
  const auto            sums       = row_sums<faces::Differential<1>>(x);
  std::vector<Row<dim>> result(sums.size());
  for (unsigned int i = 0; i < sums.size(); ++i)
    {
      const auto &n   = normals.normals()[multipliers.nodes[i]];
      Row<dim>   &row = result[i];
      row.normal      = normal_slopes[multipliers.nodes[i]];
      for (int d = 0; d < dim; ++d)
        {
          const auto mean = sums[i].offset[d] / sums[i].area;
          row.gap += row.normal[d] * mean.value + n[d] * mean.slope[0];
        }
      const auto corrected = correction(i, sums[i], x, with_slope[multipliers.nodes[i]]);
      for (unsigned int k = 0; k < row_nodes[i].size(); ++k)
        {
          const auto c = (sums[i].coefficients[k] - corrected.masses()[k]) / sums[i].area;
          row.coefficients.emplace_back(row_nodes[i][k], c.value * row.normal + c.slope[0] * n);
        }
    }
  return result;
}

template <int dim>
std::vector<double> MortarRows<dim>::areas(const Field &positions) const
{
  std::vector<double> result;
  for (const auto &sum : row_sums<double>(mortar::node_arrays<dim>(positions)))
    result.push_back(sum.area);
  return result;
}

template class MortarRows<2>;
template class MortarRows<3>;
#define SNUG_INSTANTIATE(dim)                                                      \
  template mortar::FaceIntegrals<double> MortarRows<dim>::integrals(               \
    const SlaveFace &, const mortar::FaceNodes<dim, double> &) const;              \
  template std::vector<MortarRows<dim>::RowSum<double>> MortarRows<dim>::row_sums( \
    const mortar::FaceNodes<dim, double> &) const;                                 \
  template mortar::MomentCorrection<dim, double> MortarRows<dim>::correction(      \
    unsigned int, const RowSum<double> &, const mortar::FaceNodes<dim, double> &,  \
    const std::array<double, dim> &) const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::contact
