'use strict';
// What the reader has made so far: samples, an isovalue, sites, and rounds of both stages. All else follows
// from these and is found anew when it is asked for. Every change of samples, isovalue or sites can be undone,
// and every round taken back.

const kLetters = 'ABCDEFGHJLMNPQRSUVWXYZ';
// Edges with a smaller circumradius have no limit, in voxels.
const kRMin = 0.1;

class State {
  constructor(header) {
    this.header = header;
    this.limit = 0.1;
    this.past = [];
    this.begin();
  }

  begin() {
    const { header } = this;
    this.kappa = header.isovalue;
    this.chosen_sample = this.zoomed = header.chosen;
    this.chosen = 0;
    this.set_samples(header.samples);
    this.sites = header.sites.map((place) => nearest_vertex(this.contour, place));
    this.changed();
  }
  start_again() {
    this.remember();
    this.begin();
  }

  // Before a change. Changes of one kind in a row, as a drag makes them, are undone together.
  remember(kind = null) {
    if (kind !== null && this.past.at(-1)?.kind === kind) return;
    const { kappa, chosen_sample, chosen, rounds, coarse } = this;
    this.past.push({ kind, kappa, chosen_sample, chosen, rounds, coarse, samples: [...this.field.samples],
                     sites: [...this.sites] });
  }
  undo() {
    const before = this.past.pop();
    if (!before) return;
    const { kappa, chosen_sample, chosen, rounds, coarse, samples, sites } = before;
    Object.assign(this, { kappa, chosen_sample, chosen, sites });
    this.set_samples(samples);
    this.changed();
    Object.assign(this, { rounds, coarse });
  }

  set_samples(samples) {
    this.field = new Field({ ...this.header, samples: [...samples] });
    this.set_contour();
  }
  set_contour() {
    this.contour = contour_of(this.field, this.kappa);
    this.coarse = [uncoarsened(this.contour)];
    this.chosen_vertex = -1;  // the one that the picture of coarsening is about; -1: the next in turn
    this.find_zoomed();
  }
  // The voxel that picture 2 shows large: of those whose corners alternate the nearest to the sample chosen last;
  // where there is none, the same as before.
  find_zoomed() {
    const off = ({ at }) => distance(at, this.chosen_sample), { saddles } = this.contour;
    if (saddles.length === 0) return;
    this.zoomed = saddles.reduce((best, saddle) => off(saddle) < off(best) ? saddle : best).at.map(Math.floor);
  }
  changed() {
    this.regions = regions_of(this.contour, this.sites);
    this.fault = certificate_of(this.contour, this.sites, this.regions);
    // Stage 2 begins with a K that is right: where the certificate fails, that of a copy of the sites,
    // with those that it asks for.
    this.added = certify(this.contour, this.sites).slice(this.sites.length);
    this.rounds = [first_round(this.walks([...this.sites, ...this.added]))];
    this.edge = null;  // a place on the edge that the picture of insertion is about; none: the worst
  }
  // T's loops from site to site. They are K where the certificate holds; else they meet themselves.
  walks(sites) {
    return dual_loops(this.contour, regions_of(this.contour, sites))
      .map((loop) => loop.map((n) => this.contour.points[sites[n]]));
  }
  // Sites go to the vertices of another T that are nearest.
  recontour() {
    const places = this.sites.map((v) => this.contour.points[v]);
    this.set_contour();
    this.sites = [];
    for (const place of places) {
      const v = nearest_vertex(this.contour, place, (u) => !this.sites.includes(u));
      if (v >= 0) this.sites.push(v);
    }
    this.chosen = Math.min(this.chosen, this.sites.length - 1);
    this.changed();
  }
  set_kappa(kappa) {
    if (kappa === this.kappa) return;
    this.remember('isovalue');
    this.kappa = kappa;
    this.recontour();
  }
  choose_sample(i, j) {
    this.chosen_sample = [i, j];
    this.find_zoomed();
  }
  // Samples at the sides of the slice stay, so that no loop is cut; and some of the surface stays.
  can_change(i, j) { return i > 0 && j > 0 && i < this.field.columns - 1 && j < this.field.rows - 1; }
  set_sample(value) {
    const [i, j] = this.chosen_sample, before = this.field.at(i, j);
    if (!this.can_change(i, j) || value === before) return;
    this.remember(`sample ${i} ${j}`);
    this.field.set(i, j, value);
    if (contour_of(this.field, this.kappa).points.length < 12) this.field.set(i, j, before);
    this.recontour();
  }
  add_site(v) {
    if (v < 0 || this.sites.includes(v)) return;
    this.remember();
    this.sites.push(v);
    this.chosen = this.sites.length - 1;
    this.changed();
  }
  // So many sites: the last ones go, or those come that are furthest from all others.
  set_site_count(count) {
    if (count === this.sites.length) return;
    this.remember('count');
    this.sites.length = Math.min(this.sites.length, count);
    while (this.sites.length < count) {
      const { far } = regions_of(this.contour, this.sites), v = far.indexOf(Math.max(...far));
      if (far[v] === 0) break;
      this.sites.push(v);
    }
    this.chosen = Math.min(this.chosen, this.sites.length - 1);
    this.changed();
  }
  // At the vertex of T that is furthest from its site.
  add_furthest_site() {
    const far = this.regions.far;
    const v = far.indexOf(Math.max(...far));
    if (far[v] > 0) this.add_site(v);
  }
  move_site(n, v) {
    this.chosen = n;
    if (v < 0 || this.sites[n] === v) return;
    this.remember(`site ${n}`);
    this.sites[n] = v;
    this.changed();
  }
  remove_site(n) {
    if (this.sites.length <= 1) return;
    this.remember();
    this.sites.splice(n, 1);
    this.chosen = Math.min(n, this.sites.length - 1);
    this.changed();
  }
  certify() {
    if (this.added.length === 0) return;
    this.remember();
    this.sites = certify(this.contour, this.sites);
    this.changed();
  }

  name(n) {
    const round = Math.floor(n / kLetters.length);
    return kLetters[n % kLetters.length] + (round > 0 ? round : '');
  }
  note(n) {
    const arcs = this.regions.arcs[n], count = arcs.reduce((sum, arc) => sum + arc.vertices.length, 0);
    const pieces = arcs.length > 1 ? `, in ${arcs.length} pieces` : '';
    return `${counted(count, 'vertex', 'vertices')} of T${pieces}`;
  }

  // Stage 2, as far as its rounds went. by_hand: how many have inserted something.
  get round() { return this.rounds.at(-1); }
  get loops() { return this.round.loops; }
  get by_hand() { return this.rounds.filter(({ facet, why }) => facet && why === '').length; }
  facets() {
    // All pictures ask for them; a round never changes.
    if (this.known?.round !== this.round) {
      this.known = { round: this.round, facets: facets_of(this.field, this.kappa, this.loops) };
    }
    return this.known.facets;
  }
  // The facet that Stage 2 takes next; null: it is at its end.
  next_facet(facets) { return worst_of(facets, this.limit, kRMin, this.round.refused); }
  // The facet that the picture of insertion is about: the chosen one, else the next one, else the worst.
  facet(facets) {
    const off = (f) => distance(f.center, this.edge);
    if (this.edge) return facets.reduce((best, f) => off(f) < off(best) ? f : best);
    return this.next_facet(facets) ?? facets.reduce((best, f) => f.h > best.h ? f : best);
  }
  insert() {
    const facets = this.facets();
    this.rounds = [...this.rounds, next_round(this.field, this.kappa, this.round, facets, this.facet(facets))];
    this.edge = null;
  }
  take_back_round() {
    if (this.rounds.length > 1) this.rounds = this.rounds.slice(0, -1);
    this.edge = null;
  }
  // All rounds of Stage 2 from where it is to its end.
  finished() {
    const { known_end: known, round, limit } = this;
    if (known?.round !== round || known.limit !== limit) {
      this.known_end = { round, limit, rounds: refine(this.field, this.kappa, round, limit, kRMin) };
    }
    return this.known_end.rounds;
  }

  // The coarsening of T, as far as its rounds went.
  get coarsened() { return this.coarse.at(-1); }
  // The vertex that the picture of coarsening is about; -1: none is left.
  tried_vertex() {
    if (this.is_left(this.chosen_vertex)) return this.chosen_vertex;
    return this.coarsened.waiting[0] ?? -1;
  }
  removal() {
    return removal_of(this.field, this.kappa, this.contour, this.coarsened.loops, this.tried_vertex(), this.limit);
  }
  choose_vertex(v) { this.chosen_vertex = v; }
  is_left(v) { return this.coarsened.loops.some((loop) => loop.includes(v)); }
  remove_vertex() {
    if (this.tried_vertex() < 0) return;
    const { field, kappa, contour, coarsened, limit } = this;
    this.coarse = [...this.coarse, coarsening_round(field, kappa, contour, coarsened, this.tried_vertex(), limit)];
    this.chosen_vertex = -1;
  }
  take_back_removal() {
    if (this.coarse.length > 1) this.coarse = this.coarse.slice(0, -1);
    this.chosen_vertex = -1;
  }
}
