#include <snug/mesh/grid_partition.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace snug::mesh {
namespace {
/// Return the numbers of slabs per axis. The pieces are near cubes, and the product is near n.
///
/// All counts with a product between 0.7 n and 1.4 n are rated by the logarithm of the ratio of
/// the longest to the shortest edge and, with half the weight, by the logarithm of the product
/// over n. The counts {n, 1, 1} are among the candidates.
template <int dim>
std::array<unsigned int, dim> slab_counts(const dealii::Tensor<1, dim> &size, double n)
{
  std::array<unsigned int, dim> best, counts;
  best.fill(1);
  counts.fill(1);
  double             least   = std::numeric_limits<double>::max();
  const unsigned int largest = std::ceil(1.4 * n);
  const auto         rate    = [&]() {
    double product = 1., longest = 0., shortest = std::numeric_limits<double>::max();
    for (unsigned int c = 0; c < dim; ++c)
      {
        product *= counts[c];
        longest  = std::max(longest, size[c] / counts[c]);
        shortest = std::min(shortest, size[c] / counts[c]);
      }
    if (product > 1.4 * n || product < 0.7 * n)
      return;
    const double score = std::log(longest / shortest) + 0.5 * std::abs(std::log(product / n));
    // Among equal scores the first is taken, so that round-off does not decide.
    if (score < least - 1e-12)
      {
        least = score;
        best  = counts;
      }
  };
  for (counts[0] = 1; counts[0] <= largest; ++counts[0])
    for (counts[1] = 1; counts[0] * counts[1] <= largest; ++counts[1])
      if (dim == 2)
        rate();
      else
        for (counts[dim - 1] = 1; counts[0] * counts[1] * counts[dim - 1] <= largest;
             ++counts[dim - 1])
          rate();
  return best;
}

const unsigned int n_bins = 4096;

/// The numbers of cells of all ranks in bins of equal width along one logical coordinate, and the
/// ends of the range.
struct Histogram
{
  std::vector<unsigned long> counts;
  double                     lower, upper;

  Histogram(const double lower, const double upper) : counts(n_bins, 0), lower(lower), upper(upper)
  {}

  void add(const double coordinate, const unsigned long n)
  {
    // A single layer has zero width, and all its centres belong to bin 0.
    const double width = std::max(upper - lower, 1e-300);
    counts[std::min<unsigned int>(n_bins - 1, (coordinate - lower) / width * n_bins)] += n;
  }

  double end_of(unsigned int bin) const { return lower + (upper - lower) * (bin + 1) / n_bins; }
};

/// Return the histogram of the logical coordinate @p axis of the cell centres. A histogram needs
/// two reductions, whereas a sort would need all centres on one rank. Empty bins separate layers of
/// cells if there are far fewer layers than bins. Collective.
template <int dim>
Histogram histogram(const CellSet<dim> &set, unsigned int axis)
{
  const double infinity = std::numeric_limits<double>::infinity();
  double       ends[2]  = {-infinity, -infinity};
  for (const auto &centre : set.centres)
    {
      ends[0] = std::max(ends[0], -centre[axis]);
      ends[1] = std::max(ends[1], centre[axis]);
    }
  MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_DOUBLE, MPI_MAX, set.communicator);
  Histogram bins(-ends[0], ends[1]);
  for (const auto &centre : set.centres)
    bins.add(centre[axis], 1);
  MPI_Allreduce(MPI_IN_PLACE, bins.counts.data(), n_bins, MPI_UNSIGNED_LONG, MPI_SUM,
                set.communicator);
  return bins;
}

/**
 * Return the coordinates that cut a histogram into @p n slabs with about equal
 * numbers of cells. A cut moves to the nearest gap between layers of cells if
 * this gap is within a quarter of a slab.
 */
std::vector<double> cuts(const Histogram &bins, unsigned int n)
{
  double all = 0.;
  for (const unsigned long count : bins.counts)
    all += count;
  std::vector<double> result;
  for (unsigned int k = 1; k < n; ++k)
    {
      const double wanted = k * all / n, slab = all / n;
      double       below = 0., best = bins.lower, best_rating = 1e300;
      for (unsigned int bin = 0; bin < bins.counts.size(); ++bin)
        {
          below += bins.counts[bin];
          // An empty next bin separates two layers, because the centres of a layer share a bin.
          const bool   gap = bin + 1 < bins.counts.size() && bins.counts[bin + 1] == 0;
          const double off = std::abs(below - wanted) / slab;
          // A gap within a quarter of a slab has a better rating than any cut without a gap.
          const double rating = off + (gap && off <= 0.25 ? 0. : 1.);
          if (rating < best_rating - 1e-9)
            {
              best_rating = rating;
              best        = bins.end_of(bin);
            }
        }
      result.push_back(best);
    }
  return result;
}

/// Return the first layer of each slab of an axis of a grid, and then the number of layers.
std::vector<unsigned int>
first_layers(const unsigned int n_layers, const unsigned int n_slabs, const double cells_of_layer)
{
  std::vector<unsigned int> first = {0};
  // Up to this number of layers, empty bins separate all layers, and slabs of a histogram, which
  // other bodies have, are the same to the last cell.
  if (n_layers <= n_bins / 2)
    {
      const auto centre = [&](const unsigned int layer) { return (layer + 0.5) / n_layers; };
      Histogram  bins(centre(0), centre(n_layers - 1));
      for (unsigned int layer = 0; layer < n_layers; ++layer)
        bins.add(centre(layer), static_cast<unsigned long>(cells_of_layer));
      for (const double at : cuts(bins, n_slabs))
        {
          unsigned int layer = first.back();
          while (layer < n_layers && centre(layer) < at)
            ++layer;
          first.push_back(layer);
        }
    }
  else
    for (std::uint64_t k = 1; k < n_slabs; ++k)
      // The cut is at the nearest end of a layer, and at the lower one of two.
      first.push_back((2 * k * n_layers + n_slabs - 1) / (2 * n_slabs));
  first.push_back(n_layers);
  return first;
}
} // namespace

/// The body is cut axis by axis. The cuts of an axis are logical planes through the whole body, so
/// that parts have flat sides and share whole faces. Collective.
template <int dim>
Partition grid_partition(const CellSet<dim> &set, double cells_each)
{
  const double n      = std::max(1l, std::lround(set.n_global / cells_each));
  const auto   counts = slab_counts<dim>(set.size, n);
  Partition    result;
  result.part.assign(set.centres.size(), 0);
  for (unsigned int axis = 0; axis < dim; ++axis)
    {
      const auto at = cuts(histogram(set, axis), counts[axis]);
      result.n_parts *= counts[axis];
      for (unsigned int cell = 0; cell < set.centres.size(); ++cell)
        // The number of the slab along this axis is the next digit of the number of the part.
        result.part[cell] =
          result.part[cell] * counts[axis] +
          (std::upper_bound(at.begin(), at.end(), set.centres[cell][axis]) - at.begin());
    }
  return result;
}

template <int dim>
GridParts<dim>::GridParts(const geometry::CellGrid<dim> &grid,
                          const dealii::Tensor<1, dim>  &size,
                          const double                   cells_each)
{
  const double n_cells = grid.n_cells();
  const auto   counts  = slab_counts<dim>(size, std::max(1l, std::lround(n_cells / cells_each)));
  for (unsigned int axis = 0; axis < dim; ++axis)
    first_layer[axis] = first_layers(grid.cells[axis], counts[axis], n_cells / grid.cells[axis]);
}

template <int dim>
unsigned int GridParts<dim>::n_parts() const
{
  unsigned int n = 1;
  for (unsigned int axis = 0; axis < dim; ++axis)
    n *= n_slabs(axis);
  return n;
}

template <int dim>
unsigned long GridParts<dim>::n_filled() const
{
  unsigned long n = 1;
  for (const auto &first : first_layer)
    n *= std::set<unsigned int>(first.begin(), first.end()).size() - 1;
  return n;
}

/// The parts before @p part are those in earlier slabs of axis 0, then those in the same slab of
/// axis 0 and in earlier slabs of axis 1, and so on.
template <int dim>
unsigned long GridParts<dim>::cells_before(const unsigned int part) const
{
  unsigned long rest = 1; // cells of the whole grid
  for (const auto &first : first_layer)
    rest *= first.back();
  if (part == n_parts())
    return rest;
  const auto [begin, end] = layers(part);
  unsigned long before = 0, section = 1;
  for (unsigned int axis = 0; axis < dim; ++axis)
    {
      rest /= first_layer[axis].back();
      before += section * begin[axis] * rest;
      section *= end[axis] - begin[axis];
    }
  return before;
}

template <int dim>
unsigned int GridParts<dim>::part(const Counts &at) const
{
  unsigned int part = 0;
  for (unsigned int axis = 0; axis < dim; ++axis)
    {
      const auto &first = first_layer[axis];
      part              = part * n_slabs(axis) +
             (std::upper_bound(first.begin(), first.end(), at[axis]) - first.begin() - 1);
    }
  return part;
}

template <int dim>
std::pair<typename GridParts<dim>::Counts, typename GridParts<dim>::Counts>
GridParts<dim>::layers(unsigned int part) const
{
  Counts begin, end;
  for (unsigned int axis = dim; axis-- > 0; part /= n_slabs(axis))
    {
      const unsigned int slab = part % n_slabs(axis);
      begin[axis]             = first_layer[axis][slab];
      end[axis]               = first_layer[axis][slab + 1];
    }
  return {begin, end};
}

template class GridParts<2>;
template class GridParts<3>;
template Partition grid_partition(const CellSet<2> &, double);
template Partition grid_partition(const CellSet<3> &, double);
} // namespace snug::mesh
