#include <snug/base/shared_work.h>
#include <snug/contact/mortar_rows.h>
#include <snug/contact/opposite_faces.h>
#include <snug/faces/quadratic_triangle.h>
#include <snug/faces/tributary.h>

#include <map>
#include <numeric>
#include <set>

namespace snug::contact {
namespace {
/// Faces of which less than this fraction is covered have standard multiplier functions.
const double least_biorthogonal_cover = 0.25;

/// A face that is covered except for this fraction of its extent counts as covered up to its edge,
/// so that its nodes keep rows of their own where curved sides end together.
const double uncovered_edge = 0.01;

/// A node is held if its supports leave less than this fraction of its normal free.
const double held_part = 0.1;

/// Return FaceCover::functions. The function of a hanging node belongs to its masters in the
/// displacement, and so in the rows.
template <int dim>
std::vector<std::vector<std::pair<unsigned int, double>>>
functions_of_nodes(const mesh::Surface<dim> &surface, const unsigned int face)
{
  const auto triangle = faces::quadratic_triangle(surface, face);
  std::vector<std::vector<std::pair<unsigned int, double>>> result;
  for (const unsigned int node : surface.faces()[face].nodes)
    {
      result.emplace_back();
      if (triangle)
        {
          const auto values = triangle->linear_functions(surface, node);
          for (unsigned int k = 0; k < 3; ++k)
            result.back().emplace_back(triangle->middles[k], values[k]);
        }
      else if (surface.masters(node).empty())
        result.back().emplace_back(node, 1.);
      else
        result.back().assign(surface.masters(node).begin(), surface.masters(node).end());
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
  , normals(pair)
{
  const auto opposite = opposite_faces(pair, normals);
  for (unsigned int i = 0; i < sides.slave.size(); ++i)
    if (!opposite[i].empty())
      faces.push_back({sides.slave[i], opposite[i], {}});
  choose_multipliers(pair);
  set_shares();
  collect_row_nodes();
  leave_out_far_rows(pair);
}

template <int dim>
void MortarRows<dim>::choose_multipliers(const PairGeometry<dim> &pair)
{
  const faces::NodalNormals<dim> own(surface, sides.slave, shape, pair.positions);
  std::vector<bool>              is_held(surface.n_nodes());
  for (unsigned int node = 0; node < is_held.size(); ++node)
    is_held[node] =
      pair.taken[node] || faces::free_part(own.normals()[node], held[node]).norm() < held_part;
  const auto           at_positions = normals.at(pair.positions);
  const Points<double> x(pair.positions), n(at_positions.normals());
  const auto boxes = shared_work(surface.communicator(), costs(), [&](const unsigned int f) {
    const auto          box = cover_box(faces[f], x, n);
    std::vector<double> ends(box.lower.begin(), box.lower.end());
    ends.insert(ends.end(), box.upper.begin(), box.upper.end());
    return ends;
  });
  std::vector<mortar::FaceCover> covers;
  for_each_integrals<double>(x, n, [&](const unsigned int f, const auto &part) {
    mortar::CoverBox<dim> box;
    std::copy_n(boxes[f].begin(), dim - 1, box.lower.begin());
    std::copy_n(boxes[f].begin() + dim - 1, dim - 1, box.upper.begin());
    const auto cover = choose_functions(faces[f], part, box, pair.positions);
    // A face that is opposite only within the margin of the pairing is not covered and gets no
    // multipliers.
    if (sum(cover.covered) > 0.)
      covers.push_back(cover);
  });
  multipliers = mortar::choose_multiplier_nodes(surface, covers, is_held, shape, pair.positions);
}

/// Set the shares of the functions of all faces. On a third of a quadratic triangle, the
/// multipliers of the middles of edges have the linear functions of the triangle. Its corners have
/// no row and show the mean of the adjacent middles.
template <int dim>
void MortarRows<dim>::set_shares()
{
  std::map<unsigned int, std::set<unsigned int>> middles; // by corner
  for (SlaveFace &face : faces)
    {
      face.shares.clear();
      for (const auto &functions : functions_of_nodes(surface, face.face))
        {
          std::map<unsigned int, double> shares;
          for (const auto &[node, weight] : functions)
            for (const auto &[row, share] : multipliers.shares[node])
              shares[row] += weight * share;
          face.shares.emplace_back(shares.begin(), shares.end());
        }
      if (const auto triangle = faces::quadratic_triangle(surface, face.face))
        middles[triangle->corners[0]].insert({triangle->middles[1], triangle->middles[2]});
    }
  for (const auto &[corner, of_corner] : middles)
    {
      // A corner that is on other faces, too, has a row of its own.
      if (!multipliers.shares[corner].empty())
        continue;
      std::map<unsigned int, double> shares;
      for (const unsigned int middle : of_corner)
        for (const auto &[row, share] : multipliers.shares[middle])
          shares[row] += share / double(of_corner.size());
      multipliers.shares[corner].assign(shares.begin(), shares.end());
    }
}

/// Choose the multiplier functions of a face. Return the cover of the face, by these functions.
template <int dim>
mortar::FaceCover MortarRows<dim>::choose_functions(SlaveFace                           &face,
                                                    const mortar::FaceIntegrals<double> &of_nodes,
                                                    const mortar::CoverBox<dim>         &box,
                                                    const Field &positions) const
{
  mortar::FaceCover cover = {face.face, of_nodes.slave,
                             faces::shape_integrals(surface, face.face, shape, positions),
                             functions_of_nodes(surface, face.face)};
  // The Gram matrix of shape functions over a sliver of a face is nearly singular. Its inverse
  // would give multiplier functions with large values of both signs.
  if (sum(cover.covered) < least_biorthogonal_cover * sum(cover.whole) ||
      faces::quadratic_triangle(surface, face.face))
    {
      face.functions.biorthogonal = false;
      return cover;
    }
  face.functions = mortar::functions_on(box, shape.degree(), uncovered_edge);
  cover.covered  = mortar::in_box(of_nodes, face.functions).slave;
  return cover;
}

/// Return the box that contains the covered part of the face.
template <int dim>
mortar::CoverBox<dim> MortarRows<dim>::cover_box(const SlaveFace      &face,
                                                 const Points<double> &x,
                                                 const Points<double> &n) const
{
  mortar::CoverBox<dim> box;
  const auto            slave = normals.slave_face(face.face, x, n);
  for (const unsigned int master : face.masters)
    quadrature.add_cover(slave, mortar::mortar_face(surface, shape, master, x), box);
  return box;
}

/// Collect all nodes that a row may couple while the pairing stays, including nodes with zero
/// coefficients. So B keeps its sparsity pattern while the design moves, and its symbolic
/// factorizations stay valid.
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
      for (unsigned int j = 0; j < nodes.size(); ++j)
        for (const auto &share : face.shares[j])
          {
            auto &row = reached[share.first];
            row.insert(masters.begin(), masters.end());
            // With int psi_j N_l = 0 for l != j, the row contains only the node itself of the slave
            // side.
            if (face.functions.are_nodal())
              row.insert(nodes[j]);
            else
              row.insert(nodes.begin(), nodes.end());
          }
    }
  for (const auto &nodes : reached)
    {
      // Replace hanging nodes by their masters, because hanging nodes have no unknowns.
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

/// Remove far rows together with their multiplier functions. So shares may sum to less than 1
/// afterwards, because a part of the side that is out of reach carries no pressure.
template <int dim>
void MortarRows<dim>::leave_out_far_rows(const PairGeometry<dim> &pair)
{
  const SearchCriteria<dim>     criteria(pair);
  const auto                    all           = rows(pair.positions);
  const mortar::MultiplierNodes old           = multipliers;
  const auto                    old_row_nodes = row_nodes;
  std::vector<unsigned int>     index(all.size(), all.size());
  multipliers.nodes.clear();
  row_nodes.clear();
  for (unsigned int i = 0; i < all.size(); ++i)
    // Check the gap alone, because the angles of faces were checked when they were paired.
    if (criteria.is_near(all[i].gap))
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
  set_shares();
}

template MortarRows<2>::MortarRows(const PairGeometry<2> &);
template MortarRows<3>::MortarRows(const PairGeometry<3> &);
} // namespace snug::contact
