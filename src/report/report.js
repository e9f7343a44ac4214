/* All figures show the same time: a cursor in every plot, the values at the cursor, and the animation. */
(function () {
  'use strict';
  /* A link to a check of a folded table unfolds it. */
  function unfold() {
    var target = document.getElementById(location.hash.slice(1));
    if (!target || !target.closest('details')) return;
    target.closest('details').open = true;
    target.scrollIntoView();
  }
  addEventListener('hashchange', unfold);
  unfold();

  var source = document.getElementById('data');
  if (!source) return;
  var raw = JSON.parse(source.textContent), data = {}, decimals = {};

  /* Channels are whole numbers of a decimal unit, given by second differences (page_data.c): +3, -12; z5: five zeros;
     n5: five missing values. */
  function unpack(text, unit) {
    var values = [], last = 0, step = 0;
    text.replace(/([zn])(\d*)|[-+]\d+/g, function (word, run, times) {
      for (var k = run ? Number(times || 1) : 1; k > 0; k--) {
        if (run === 'n') { values.push(NaN); continue; }
        step += run ? 0 : Number(word);
        last += step;
        values.push(last / unit);
      }
    });
    return values;
  }
  Object.keys(raw).forEach(function (name) {
    if (name === 'events') return;
    decimals[name] = raw[name][0];
    data[name] = unpack(raw[name][1], Math.pow(10, raw[name][0]));
  });
  var time = data.t_ms, last = time.length - 1, now = 0;

  function all(selector, inside) { return Array.prototype.slice.call((inside || document).querySelectorAll(selector)); }
  function numbers(text) { return text.split(' ').map(Number); }
  function svg(name, attributes, parent) {
    var element = document.createElementNS('http://www.w3.org/2000/svg', name);
    Object.keys(attributes).forEach(function (key) { element.setAttribute(key, attributes[key]); });
    return parent.appendChild(element);
  }
  function nearest(value) {
    var low = 0, high = last;
    while (high - low > 1) {
      var middle = (low + high) >> 1;
      if (time[middle] > value) high = middle; else low = middle;
    }
    return value - time[low] > time[high] - value ? high : low;
  }

  /* ---- plots ---- */
  var plots = all('svg.plot').filter(function (element) {
    return element.classList.contains('time') ? true : element.querySelector('path[data-x]');
  }).map(function (element) {
    var box = numbers(element.dataset.box), range = numbers(element.dataset.range);
    var curves = all('path[data-y]', element).filter(function (path) { return data[path.dataset.y]; });
    var plot = {element: element, box: box, range: range, loop: false};
    plot.curves = curves.map(function (path) {
      if (path.dataset.x) plot.loop = true;
      return {x: data[path.dataset.x || 't_ms'], y: data[path.dataset.y], channel: path.dataset.y,
              xChannel: path.dataset.x, name: path.dataset.name || path.dataset.y,
              dot: svg('circle', {r: 3.2, fill: path.getAttribute('stroke'), 'class': 'dot'}, element)};
    });
    if (!plot.loop) plot.line = svg('line', {y1: box[1], y2: box[1] + box[3], stroke: 'currentColor', 'stroke-width': 0.8, 'class': 'cursor'}, element);
    plot.output = document.createElement('output');
    element.parentNode.appendChild(plot.output);
    element.addEventListener('pointermove', function (event) { point(plot, event); });
    return plot;
  });
  function px(plot, x) { return plot.box[0] + (x - plot.range[0]) / (plot.range[1] - plot.range[0]) * plot.box[2]; }
  function py(plot, y) { return plot.box[1] + (plot.range[3] - y) / (plot.range[3] - plot.range[2]) * plot.box[3]; }

  function point(plot, event) {
    var place = plot.element.createSVGPoint();
    place.x = event.clientX;
    place.y = event.clientY;
    place = place.matrixTransform(plot.element.getScreenCTM().inverse());
    if (!plot.loop) {
      var share = (place.x - plot.box[0]) / plot.box[2];
      if (Math.abs(share - 0.5) > 0.5) return;
      show(nearest(plot.range[0] + share * (plot.range[1] - plot.range[0])));
      return;
    }
    var best = 0, smallest = Infinity, curve = plot.curves[0];
    curve.x.forEach(function (x, i) {
      var d = Math.hypot(px(plot, x) - place.x, py(plot, curve.y[i]) - place.y);
      if (smallest > d) { smallest = d; best = i; }
    });
    show(best);
  }
  function text(channel) { var value = data[channel][now]; return isNaN(value) ? '\u2013' : value.toFixed(decimals[channel]); }
  function drawPlot(plot) {
    if (plot.line) {
      plot.line.setAttribute('x1', px(plot, time[now]));
      plot.line.setAttribute('x2', px(plot, time[now]));
    }
    plot.output.textContent = text('t_ms') + ' ms' + plot.curves.map(function (curve) {
      curve.dot.setAttribute('cx', px(plot, curve.x[now]));
      curve.dot.setAttribute('cy', isNaN(curve.y[now]) ? -9 : py(plot, curve.y[now]));
      return plot.loop ? ' \u00b7 closure ' + text(curve.xChannel) + ' mm, force ' + text(curve.channel) + ' kN'
                       : ' \u00b7 ' + curve.name + ' ' + text(curve.channel);
    }).join('');
  }

  /* ---- animation ---- */
  var stage = document.querySelector('svg.animation');
  var S = Number(stage.dataset.scale), M = Number(stage.dataset.magnify);
  var cars = all('g.car', stage).map(function (group) {
    var own = group.dataset, car = {group: group, name: own.car, at: Number(own.at), cg: Number(own.cg), body: group.querySelector('.body'),
      wheels: all('.wheel', group), frames: all('.frame', group)};
    ['rear', 'front'].forEach(function (side) {
      car[side] = {end: group.querySelector('.end.' + side), face: group.querySelector('.face.' + side), coupler: group.querySelector('.coupler.' + side),
        bare: Number(own[side]), faceAt: Number(own[side + 'Face']), pivot: Number(own[side + 'Pivot']), tip: Number(own[side + 'Tip'])};
    });
    car.radius = car.wheels.map(function (wheel) { return Number(wheel.getAttribute('r')); });
    car.axle = car.frames.map(function (frame, i) { return Number(frame.getAttribute('y1')); });
    return car;
  });
  function value(stem, name, unit) {
    var channel = data[stem + '_' + name + '_' + unit];
    return channel ? channel[now] : 0;
  }
  function place(car) { return car.at + value('x', car.name, 'm'); }
  function drawEnd(car, side, neighbour) {
    var end = car[side], sign = side === 'front' ? S : -S;
    var crushed = value('d_end', side + '_' + car.name, 'mm') / 1000;
    var worn = value('d_anti-climber', side + '_' + car.name, 'mm') / 1000;
    if (end.end) end.end.setAttribute('x2', sign * (end.bare - crushed));
    if (end.face) {
      end.face.setAttribute('x1', sign * (end.bare - crushed));
      end.face.setAttribute('x2', sign * (end.faceAt - crushed - worn));
    }
    if (!end.coupler) return;
    var other = neighbour ? neighbour[side === 'front' ? 'rear' : 'front'] : {}, length = end.tip - end.pivot, tip = end.tip;
    if (other.coupler) {
      var apart = Math.abs(place(neighbour) - place(car)) - end.pivot - other.pivot;
      tip = end.pivot + Math.min(length, Math.max(apart, 0) * length / (length + other.tip - other.pivot));
    }
    end.coupler.setAttribute('x2', sign * tip);
  }
  function drawCar(car, i, origin) {
    var pitch = value('pitch', car.name, 'mrad') / 1000, lift = [];
    car.group.setAttribute('transform', 'translate(' + S * (place(car) - origin) + ' 0)');
    car.body.setAttribute('transform', 'translate(0 ' + -S * M * value('z', car.name, 'mm') / 1000 + ') rotate(' + -M * pitch * 180 / Math.PI + ' 0 ' + -S * car.cg + ')');
    drawEnd(car, 'rear', cars[i - 1]);
    drawEnd(car, 'front', cars[i + 1]);
    car.wheels.forEach(function (wheel, k) {
      lift[k] = S * M * value('z', car.name + '_w' + (k + 1), 'mm') / 1000;
      wheel.setAttribute('cy', -car.radius[k] - lift[k]);
    });
    car.frames.forEach(function (frame, k) {
      frame.setAttribute('y1', car.axle[k] - lift[2 * k]);
      frame.setAttribute('y2', car.axle[k] - lift[2 * k + 1]);
    });
  }
  var focus = document.getElementById('focus'), scrub = document.getElementById('scrub'), play = document.getElementById('play');
  var speed = document.getElementById('speed'), shown = document.getElementById('now'), sleepers = stage.querySelector('.sleepers');
  function drawStage() {
    var k = focus.selectedIndex, a = cars[k], b = cars[k + 1];
    var origin = (place(a) + a.front.bare + place(b) - b.rear.bare) / 2;
    cars.forEach(function (car, i) { drawCar(car, i, origin); });
    sleepers.setAttribute('stroke-dashoffset', S * origin - 480);
    var event = raw.events.filter(function (e) { return time[now] + 0.05 >= e[0]; }).pop();
    shown.textContent = text('t_ms') + ' ms \u00b7 ' + focus.value + ' ' + value('F', focus.value, 'kN').toFixed(0) + ' kN, closure ' +
      value('d', focus.value, 'mm').toFixed(0) + ' mm' + (event ? ' \u00b7 ' + event[1] + ' at ' + event[0] + ' ms' : '');
  }

  function show(index) {
    now = index;
    scrub.value = time[now];
    plots.forEach(drawPlot);
    drawStage();
  }
  scrub.max = time[last];
  scrub.step = time[1] - time[0];
  scrub.addEventListener('input', function () { show(nearest(Number(scrub.value))); });
  focus.addEventListener('change', function () { show(now); });

  /* Simulated time runs at the chosen share of real time. */
  var running = false, before, clock;
  function step(stamp) {
    if (!running) return;
    if (before !== undefined) clock += (stamp - before) * Number(speed.value);
    before = stamp;
    show(nearest(clock));
    if (clock >= time[last]) toggle(); else requestAnimationFrame(step);
  }
  function toggle() {
    running = !running;
    play.textContent = running ? 'Pause' : 'Play';
    before = undefined;
    clock = now >= last ? 0 : time[now];
    if (running) requestAnimationFrame(step);
  }
  play.addEventListener('click', toggle);
  document.body.classList.add('live');
  show(0);
}());
