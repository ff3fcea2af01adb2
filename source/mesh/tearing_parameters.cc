#include <snug/base/entries.h>
#include <snug/mesh/partition.h>

namespace snug::mesh {
void TearingParameters::declare(Entries &entries)
{
  const auto form = allowed("auto or a whole number of at least 1");
  entries.add("Subdomains", count_or_auto(subdomains),
              with_meanings(form,
                            {{"auto", "number that follows from the numbers of cells and ranks"}}),
              "The target number of subdomains of all bodies on all ranks. The minimum is one per "
              "rank.");
  entries.add("Method", method, choice(names(partition_table())),
              "The method that divides a body into subdomains.");
  entries.add(
    "Subdomains per cluster edge", count_or_auto(cluster_edge),
    with_meanings(form, {{"auto",
                          "1 for at most 2,500 subdomains or where soft modes are found, otherwise "
                          "the minimum with at most 1,000 clusters"}}),
    "The number of subdomains along the edge of a cluster. The faces inside a cluster join its "
    "subdomains, and the coarse problem has unknowns for clusters only. Clusters need more "
    "F-mults. Above 1 the solver must be active set, and no soft modes are used.");
}
} // namespace snug::mesh
