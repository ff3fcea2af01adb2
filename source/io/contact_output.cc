#include <snug/base/assertions.h>
#include <snug/base/narrow.h>
#include <snug/base/run_context.h>
#include <snug/faces/nodal_normals.h>
#include <snug/io/contact_output.h>
#include <snug/io/state_files.h>
#include <snug/io/surface_pieces.h>
#include <snug/io/text_file.h>
#include <snug/io/vtu_grid.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace snug::io {
/// Fields at the nodes of the surface, positions also at the samples, which normals need. This
/// struct is not in the unnamed namespace, because gcc warns of captures of such types elsewhere.
template <int dim>
struct SurfaceFields
{
  typename mesh::Surface<dim>::Field reference, positions, displacement;
};

namespace {
template <int dim>
using Sources = typename ContactOutput<dim>::Sources;

/// Return the point of a shared node. Pressure and gap are interpolated by the shares of other
/// points, flags are set if all points have them. Force and area stay 0, so that sums over nodes
/// count no force or area twice.
template <typename Shares, typename Point>
state::ContactPoint shared_point(const Shares &shares, const Point &point)
{
  state::ContactPoint result;
  result.active = result.weak = true;
  for (const auto &[index, share] : shares)
    {
      const state::ContactPoint &other = point(index);
      result.pressure += share * other.pressure;
      result.gap += share * other.gap;
      result.traction += share * other.traction;
      result.slip += share * other.slip;
      result.active = result.active && other.active;
      result.weak   = result.weak && other.weak;
    }
  return result;
}

/// Return the sources of tied pairs.
template <int dim>
Sources<dim> ties_of(const Sources<dim> &of)
{
  const auto &ties = *of.ties;
  return {of.mesh,   of.surface,  ties.joined_pairs(), ties.places(), ties.dependent_multipliers(),
          of.placed, of.number_of};
}

/// Return the points of the rows of the joined pair @p p, per surface node.
template <int dim>
std::vector<state::ContactPoint> nodal_points(const Sources<dim>                     &sources,
                                              const unsigned int                      p,
                                              const std::vector<state::ContactPoint> &rows)
{
  SNUG_ASSERT_EQUAL(rows.size(), sources.places.size());
  std::vector<state::ContactPoint> points(sources.surface.n_nodes());
  std::vector<bool>                seen(points.size(), false);
  for (unsigned int i = 0; i < rows.size(); ++i)
    if (sources.places[i].pair == p)
      {
        points[sources.places[i].slave] = rows[i];
        seen[sources.places[i].slave]   = true;
      }
  // Set shared nodes before hanging nodes, because masters of hanging nodes may show shares of
  // rows.
  for (const auto &shared : sources.dependent_multipliers)
    if (!seen[shared.node] && sources.places[shared.rows[0].first].pair == p)
      points[shared.node] = shared_point(shared.rows, [&](unsigned int row) { return rows[row]; });
  for (unsigned int node = 0; node < points.size(); ++node)
    if (!sources.surface.masters(node).empty())
      points[node] = shared_point(sources.surface.masters(node),
                                  [&](unsigned int master) { return points[master]; });
  return points;
}

/// Return whether surface nodes have a row of a joined pair, by pair and node.
template <int dim>
std::vector<std::vector<bool>> candidates(const Sources<dim> &sources)
{
  std::vector<std::vector<bool>> result(sources.pairs.size(),
                                        std::vector<bool>(sources.surface.n_nodes(), false));
  for (const auto &row : sources.places)
    result[row.pair][row.slave] = true;
  return result;
}

/// Return the quantities at the points of the VTU file.
template <int dim>
std::vector<Quantity> quantities(const bool friction, const bool ties)
{
  std::vector<Quantity> result = {{"pressure", 1},       {"gap", 1},
                                  {"force", 1},          {"area", 1},
                                  {"active", 1},         {"weak", 1},
                                  {"candidate", 1},      {"slave", 1},
                                  {"pair", 1},           {"body", 1},
                                  {"displacement", dim}, {"design_displacement", dim}};
  if (friction)
    result.insert(result.end(), {{"traction", dim}, {"slip", dim}, {"friction", 1}});
  if (ties)
    result.insert(result.end(), {{"tie_tension", 1}, {"tie_shear", dim}});
  return result;
}

/// This class makes the grids of the contact boundaries. A node on the edge of two pairs has a
/// point in each, because each pair shows its own values on its own faces.
template <int dim>
class FaceBlocks
{
public:
  FaceBlocks(const Sources<dim>             &sources,
             const state::ContactState<dim> &state,
             const SurfaceFields<dim>       &fields)
    : sources(sources)
    , fields(fields)
    , friction(state.has_friction())
    , candidate(candidates<dim>(sources))
    , empty(quantities<dim>(friction, sources.ties != nullptr), {})
  {
    // Rank 0 writes. The other ranks only need the names of the blocks.
    const bool writes = dealii::Utilities::MPI::this_mpi_process(sources.mesh.communicator()) == 0;
    for (unsigned int p = 0; writes && p < sources.pairs.size(); ++p)
      nodal.push_back(nodal_points<dim>(sources, p, state.contact));
    for (unsigned int p = 0; writes && sources.ties && p < sources.ties->pairs().size(); ++p)
      tied.push_back(nodal_points<dim>(ties_of<dim>(sources), p, state.tied));
    for (const auto &face : sources.surface.faces())
      {
        auto &grid = grids.try_emplace({face.body, face.boundary}, Grid{empty, {}}).first->second;
        if (writes)
          add(face, grid);
      }
  }

  std::string declarations() const { return empty.declarations(); }

  /// Return the blocks with the names of bodies and boundaries, with their cells on rank 0 alone.
  std::vector<Block> blocks(const std::vector<std::string> &body_names,
                            const unsigned int              compression) const
  {
    std::vector<Block> result;
    for (const auto &[side, of_side] : grids)
      result.push_back({"boundaries",
                        body_names[side.first] + '.' +
                          sources.mesh.geometry(side.first).boundary_names()[side.second],
                        of_side.grid.is_empty() ? std::string() : of_side.grid.piece(compression)});
    return result;
  }

private:
  using Face = typename mesh::Surface<dim>::Face;

  struct Grid
  {
    VtuGrid<dim - 1, dim>                grid;
    std::map<unsigned int, unsigned int> number; ///< of the point of a node
  };

  void add(const Face &face, Grid &of_side)
  {
    const auto &pairs = sources.pairs;
    const auto  found = std::find_if(pairs.begin(), pairs.end(), [&](const auto &of) {
      return contact::is_on(face, of.pair.slave);
    });
    // A face shows one pair, which is its first pair. All faces of a boundary have the same one.
    const unsigned int p = found - pairs.begin();
    auto &[grid, number] = of_side;
    std::vector<unsigned int> corners;
    for (const unsigned int node : face.nodes)
      {
        const auto [place, is_new] = number.try_emplace(node, 0);
        if (is_new)
          place->second = grid.add_point(fields.positions[node], values(face, node, p));
        corners.push_back(place->second);
      }
    grid.add_cell(corners, {});
  }

  /// Return the values of a node in the order of quantities(). @param[in] p The joined pair of the
  /// slave side, or the number of pairs.
  std::vector<double> values(const Face &face, const unsigned int node, const unsigned int p) const
  {
    // A master side may share its edge with a slave side.
    const bool slave = p < nodal.size();
    const int  pair =
      slave ? narrow<int>(sources.pairs[p].pair_of({face.body, face.boundary}, {})) : -1;
    const auto          point  = slave ? nodal[p][node] : state::ContactPoint();
    std::vector<double> result = {point.pressure,
                                  point.gap,
                                  point.force,
                                  point.area,
                                  double(point.active),
                                  double(point.weak),
                                  double(slave && candidate[p][node]),
                                  double(slave),
                                  double(pair),
                                  double(face.body)};
    const auto          append = [&](const auto &vector) {
      for (unsigned int c = 0; c < dim; ++c)
        result.push_back(vector[c]);
    };
    append(fields.displacement[node]);
    append(fields.positions[node] - fields.reference[node]);
    if (friction)
      {
        append(point.traction);
        append(point.slip);
        result.push_back(double(point.friction));
      }
    if (sources.ties != nullptr)
      {
        state::ContactPoint of_tie;
        for (unsigned int t = 0; t < tied.size(); ++t)
          if (contact::is_on(face, sources.ties->pairs()[t].slave))
            of_tie = tied[t][node];
        result.push_back(0. - of_tie.pressure);
        append(of_tie.traction);
      }
    return result;
  }

  const Sources<dim>                                   &sources;
  const SurfaceFields<dim>                             &fields;
  const bool                                            friction;
  const std::vector<std::vector<bool>>                  candidate;
  const VtuGrid<dim - 1, dim>                           empty;
  std::vector<std::vector<state::ContactPoint>>         nodal; ///< per joined pair and node
  std::vector<std::vector<state::ContactPoint>>         tied;  ///< the same of tied pairs
  std::map<std::pair<unsigned int, unsigned int>, Grid> grids; ///< of (body, boundary)
};

/// Places of the surface nodes along the contact faces.
template <int dim>
struct Places
{
  std::vector<unsigned int>          piece, place; ///< piece of each node, its place in the piece
  std::vector<double>                arc_length;   ///< in 2D from the begin of the piece [length]
  typename mesh::Surface<dim>::Field normals;      ///< unit outward normals
};

/// Return the places of the nodes of slave sides. A node between two pieces belongs to the first.
template <int dim>
Places<dim> places_of(const Sources<dim>                       &sources,
                      const typename mesh::Surface<dim>::Field &positions)
{
  const auto                 &surface = sources.surface;
  const faces::FaceShape<dim> shape(sources.mesh.degree());
  const auto                  pieces = surface_pieces(surface);
  const unsigned int          none   = narrow<unsigned int>(pieces.size());
  Places<dim>                 result{std::vector<unsigned int>(surface.n_nodes(), none),
                     std::vector<unsigned int>(surface.n_nodes(), 0),
                     std::vector<double>(surface.n_nodes(), 0.),
                     typename mesh::Surface<dim>::Field(surface.n_nodes())};
  std::vector<bool>           has_row(surface.n_nodes(), false);
  for (const auto &row : sources.places)
    has_row[row.slave] = true;
  for (unsigned int p = 0; p < none; ++p)
    {
      const auto &nodes = pieces[p].nodes;
      if (std::none_of(nodes.begin(), nodes.end(), [&](unsigned int n) { return has_row[n]; }))
        continue;
      const auto normals =
        faces::NodalNormals<dim>(surface, pieces[p].faces, shape, positions).normals();
      double       arc_length = 0.;
      unsigned int place = 0, previous = pieces[p].nodes.front();
      for (const unsigned int node : pieces[p].nodes)
        {
          arc_length += (positions[node] - positions[previous]).norm();
          previous = node;
          if (result.piece[node] != none)
            continue;
          result.piece[node]      = p;
          result.place[node]      = place++;
          result.arc_length[node] = arc_length;
          result.normals[node]    = normals[node];
        }
    }
  return result;
}

/// Return one line per row, sorted by pair and along the faces. Nodes of several pairs have several
/// lines. Positions and normals are those of the slaves. @p tied: the rows are those of ties.
template <int dim>
std::string rows_text(const Sources<dim>             &sources,
                      const state::ContactState<dim> &state,
                      const SurfaceFields<dim>       &fields,
                      const bool                      tied)
{
  const std::string axes     = dim == 3 ? "xyz" : "xy";
  const bool        friction = !tied && state.has_friction();
  const auto       &points   = tied ? state.tied : state.contact;
  std::string       text     = "pair,node,";
  for (const char axis : axes)
    text += std::string(1, axis) + ',';
  for (const char axis : axes)
    text += std::string("normal_") + axis + ',';
  text += dim == 2 ? "arc_length," : "";
  text += tied ? "force,tension,area" : "force,pressure,gap,area,active,weak";
  for (const std::string name : {tied ? "shear" : "traction", tied ? "shear_force" : "slip"})
    for (unsigned int c = 0; (tied || friction) && c < dim; ++c)
      text += "," + name + "_" + axes[c];
  text += friction ? ",friction\n" : "\n";
  const auto                at = places_of<dim>(sources, fields.positions);
  std::vector<unsigned int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](const unsigned int i, const unsigned int j) {
    const auto key = [&](const unsigned int row) {
      const auto &place = sources.places[row];
      return std::tuple(place.named, at.piece[place.slave], at.place[place.slave]);
    };
    return key(i) < key(j);
  });
  for (const unsigned int i : order)
    {
      const auto &row   = sources.places[i];
      const auto &point = points[i];
      using Numbers     = std::vector<double>;
      const auto append = [&text](const auto &vector) {
        for (unsigned int c = 0; c < dim; ++c)
          text += ',' + rounded(vector[c] + 0.); // 0 instead of -0
      };
      text += std::to_string(row.named) + ',' +
              std::to_string(sources.number_of[sources.surface.global_node(row.slave)] + 1);
      append(fields.positions[row.slave]);
      append(at.normals[row.slave]);
      text += dim == 2 ? ',' + rounded(at.arc_length[row.slave]) : "";
      for (const double x : tied ? Numbers{-point.force, -point.pressure, point.area}
                                 : Numbers{point.force, point.pressure, point.gap, point.area})
        text += ',' + rounded(x);
      if (!tied)
        text += std::string(point.active ? ",1" : ",0") + (point.weak ? ",1" : ",0");
      for (const auto &vector : {point.traction, tied ? -point.shear : point.slip})
        if (tied || friction)
          append(vector);
      text += friction ? "," + to_text(point.friction) + '\n' : "\n";
    }
  return text;
}
} // namespace

template <int dim>
std::string ContactOutput<dim>::write(const Sources                  &of,
                                      const double                    time,
                                      const state::ContactState<dim> &state)
{
  const auto              &placed = of.placed;
  const SurfaceFields<dim> fields{placed.to_space(
                                    of.surface.gather_nodes(of.mesh.reference_positions())),
                                  placed.to_space(of.surface.gather(state.positions)),
                                  placed.turned(of.surface.gather_nodes(state.displacement))};
  const std::string        stem = "contact-" + padded(series.size(), 4);
  // Extend the series on all ranks, because the next stem depends on its size.
  series.emplace_back(time, stem + ".vtm");
  const MPI_Comm        comm = of.mesh.communicator();
  const FaceBlocks<dim> faces(of, state, fields);
  write_state(comm, directory, stem, faces.blocks(body_names, compression), faces.declarations(),
              1);
  // Rank 0 writes. If it fails, all ranks fail, because otherwise all other ranks would wait for
  // rank 0 in the next reduction.
  throw_collectively(comm, [&] {
    if (dealii::Utilities::MPI::this_mpi_process(comm) != 0)
      return;
    write_text_file(directory + "/" + stem + ".csv", rows_text<dim>(of, state, fields, false));
    if (of.ties != nullptr)
      write_text_file(directory + "/ties-" + padded(series.size() - 1, 4) + ".csv",
                      rows_text<dim>(ties_of<dim>(of), state, fields, true));
    write_text_file(directory + "/contact.pvd", pvd(series));
  });
  return series.back().second;
}

template class ContactOutput<2>;
template class ContactOutput<3>;
} // namespace snug::io
