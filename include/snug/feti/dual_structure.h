#ifndef snug_feti_dual_structure_h
#define snug_feti_dual_structure_h

#include <snug/feti/cluster_structure.h>
#include <snug/feti/factor_cache.h>
#include <snug/feti/feti_parameters.h>
#include <snug/feti/row_gram.h>

namespace snug::feti {
/// This struct is the part of the dual problem that depends on the pairing alone: the layout of the
/// rows, the structure of coarse vectors, and the patterns of G G' and B D^-1 B'.
struct DualStructure
{
  /// Build the patterns. @p the_layout and @p the_cache must outlive this object. Collective.
  DualStructure(const RowLayout      &the_layout,
                const SubdomainTable &table,
                const FetiParameters &the_parameters,
                const FactorCache    &the_cache)
    : layout(the_layout)
    , parameters(the_parameters)
    , cache(the_cache)
    , coarse(the_layout, table, the_parameters.coarse_ranks)
    , clusters(coarse.table, the_layout.communicator())
    , gram(the_layout, table)
  {}

  /// Return whether soft modes are enabled and at least one subdomain may have some. Collective.
  bool seeks_soft_modes(const std::vector<SubdomainSystem> &systems) const;

  const RowLayout       &layout;
  const FetiParameters   parameters;
  const FactorCache     &cache;
  const CoarseStructure  coarse;
  const ClusterStructure clusters;
  const RowGramStructure gram;
};
} // namespace snug::feti

#endif
