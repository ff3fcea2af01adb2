#include <snug/mesh/partition.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace snug
{
  namespace mesh
  {
    namespace
    {
      template <int dim>
      using Boxes = std::vector<dealii::BoundingBox<dim>>;

      template <int dim>
      std::vector<unsigned int>
      metis_parts(const CellGraph &graph,
                  const Boxes<dim> &,
                  unsigned int n_parts)
      {
        std::vector<unsigned int> part(graph.size(), 0);
        if (n_parts <= 1)
          return part;
        if (n_parts >= graph.size())
          {
            std::iota(part.begin(), part.end(), 0);
            return part;
          }
        dealii::DynamicSparsityPattern dynamic(graph.size(), graph.size());
        for (unsigned int i = 0; i < graph.size(); ++i)
          for (const unsigned int j : graph[i])
            dynamic.add(i, j);
        dealii::SparsityPattern pattern;
        pattern.copy_from(dynamic);
        dealii::SparsityTools::partition(
          pattern, n_parts, part, dealii::SparsityTools::Partitioner::metis);
        return part;
      }

      /// Size of the box around the listed boxes.
      template <int dim>
      std::array<double, dim>
      extents(const Boxes<dim> &boxes)
      {
        std::array<double, dim> size;
        for (unsigned int c = 0; c < dim; ++c)
          {
            double lower = boxes.front().lower_bound(c);
            double upper = boxes.front().upper_bound(c);
            for (const auto &box : boxes)
              {
                lower = std::min(lower, box.lower_bound(c));
                upper = std::max(upper, box.upper_bound(c));
              }
            size[c] = upper - lower;
          }
        return size;
      }

      /// Numbers of slabs per axis: pieces near cubes, their product near n.
      template <int dim>
      std::array<unsigned int, dim>
      slab_counts(const std::array<double, dim> &size, unsigned int n)
      {
        std::array<unsigned int, dim> best, counts;
        best.fill(1);
        counts.fill(1);
        double             least   = std::numeric_limits<double>::max();
        const unsigned int largest = std::ceil(1.4 * n);
        const auto         rate    = [&]() {
          double product = 1., longest = 0.,
                 shortest = std::numeric_limits<double>::max();
          for (unsigned int c = 0; c < dim; ++c)
            {
              product *= counts[c];
              longest  = std::max(longest, size[c] / counts[c]);
              shortest = std::min(shortest, size[c] / counts[c]);
            }
          if (product > 1.4 * n || product < 0.7 * n)
            return;
          const double score = std::log(longest / shortest) +
                               0.5 * std::abs(std::log(product / n));
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
              for (counts[dim - 1] = 1;
                   counts[0] * counts[1] * counts[dim - 1] <= largest;
                   ++counts[dim - 1])
                rate();
        return best;
      }

      /**
       * Cut cells, sorted along @p axis, into @p n slabs of about equal
       * numbers; a cut moves to the nearest gap between layers of cells if
       * one is within a quarter of a slab.
       */
      template <int dim>
      std::vector<std::vector<unsigned int>>
      slabs(std::vector<unsigned int> cells,
            const Boxes<dim>         &boxes,
            unsigned int              axis,
            unsigned int              n)
      {
        const auto at = [&](unsigned int cell, unsigned int c) {
          return boxes[cell].center()[c];
        };
        double spread = 0.;
        for (const unsigned int cell : cells)
          spread = std::max(spread, boxes[cell].side_length(axis));
        // layers differ by much more than a cell's warp
        const double gap = 0.02 * spread;
        std::sort(cells.begin(), cells.end(), [&](unsigned a, unsigned b) {
          if (std::abs(at(a, axis) - at(b, axis)) > 1e-9 * spread)
            return at(a, axis) < at(b, axis);
          return a < b;
        });
        const auto is_gap = [&](std::size_t i) {
          return i == 0 || i >= cells.size() ||
                 at(cells[i], axis) - at(cells[i - 1], axis) > gap;
        };
        const double             each = double(cells.size()) / n;
        std::vector<std::size_t> cuts(1, 0);
        for (unsigned int k = 1; k < n; ++k)
          {
            std::size_t cut = std::lround(k * each);
            for (std::size_t move = 0; move <= each / 4; ++move)
              if (is_gap(cut + move) || (move <= cut && is_gap(cut - move)))
                {
                  cut = is_gap(cut + move) ? cut + move : cut - move;
                  break;
                }
            cuts.push_back(std::min(std::max(cut, cuts.back()), cells.size()));
          }
        cuts.push_back(cells.size());
        std::vector<std::vector<unsigned int>> result;
        for (unsigned int k = 0; k < n; ++k)
          if (cuts[k] < cuts[k + 1])
            result.emplace_back(cells.begin() + cuts[k],
                                cells.begin() + cuts[k + 1]);
        return result;
      }

      template <int dim>
      std::vector<unsigned int>
      grid_parts(const CellGraph &,
                 const Boxes<dim> &boxes,
                 unsigned int      n_parts)
      {
        const auto counts = slab_counts<dim>(extents<dim>(boxes), n_parts);
        std::vector<std::vector<unsigned int>> parts(1);
        parts[0].resize(boxes.size());
        std::iota(parts[0].begin(), parts[0].end(), 0);
        for (unsigned int axis = 0; axis < dim; ++axis)
          {
            std::vector<std::vector<unsigned int>> finer;
            for (const auto &part : parts)
              for (const auto &slab :
                   slabs<dim>(part, boxes, axis, counts[axis]))
                finer.push_back(slab);
            parts = finer;
          }
        std::vector<unsigned int> part_of_cell(boxes.size());
        for (unsigned int part = 0; part < parts.size(); ++part)
          for (const unsigned int cell : parts[part])
            part_of_cell[cell] = part;
        return part_of_cell;
      }
    } // namespace

    template <int dim>
    const ChoiceTable<
      std::vector<unsigned int>(const CellGraph &,
                                const std::vector<dealii::BoundingBox<dim>> &,
                                unsigned int)> &
    partition_table()
    {
      static const ChoiceTable<std::vector<unsigned int>(
        const CellGraph &, const Boxes<dim> &, unsigned int)>
        table = {{"grid",
                  "a grid of slabs along the axes, cut between layers of "
                  "cells; near cubes, which need fewest iterations",
                  grid_parts<dim>},
                 {"METIS",
                  "parts of the cell graph with few shared faces, for meshes "
                  "without layers",
                  metis_parts<dim>}};
      return table;
    }

    template const ChoiceTable<
      std::vector<unsigned int>(const CellGraph &,
                                const std::vector<dealii::BoundingBox<2>> &,
                                unsigned int)> &
    partition_table<2>();
    template const ChoiceTable<
      std::vector<unsigned int>(const CellGraph &,
                                const std::vector<dealii::BoundingBox<3>> &,
                                unsigned int)> &
    partition_table<3>();
  } // namespace mesh
} // namespace snug
